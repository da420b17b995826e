// A node of a behaviour tree.
//
//            tick                        tick: onStart, onTick
//   ended <--------- RUNNING <-------------------------------- idle or ended
//   (SUCCESS,        ^  |   \ halt, each tick until released
//    FAILURE,  tick: |  |    \--------------------------------> IDLE
//    SKIPPED)     on |  | suspend, each tick until released
//             Resume |  v
//                  SUSPENDED --- halt (at once) --------------> IDLE
//
// Letting go may take several ticks: the parent asks suspend() or halt() once a tick until the answer is kReleased, and
// hands the vehicle to nobody else before. suspend() keeps the progress, halt() drops it. A node that is ticked while
// it is letting go for a suspension simply goes on (onResume); one that is being halted first finishes that.
//
// Time is handed in with each tick; no node looks at a clock. Single-threaded.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/port.hpp"
#include "behaviors/tree/status.hpp"

namespace swiftlet::tree {

class Node;

/// Another child of a Priority has the vehicle, or is about to.
struct Switch {
  enum class Kind : unsigned char {
    kLetsGo,  ///< `from` was asked to let go for `to`; it may take several ticks.
    kTakes,   ///< `to` has the vehicle from this tick on.
    kKeeps,   ///< `to` (which is also `from`) goes on after all: who asked for the vehicle asks no longer.
  };
  Kind kind = Kind::kTakes;
  const Node* priority = nullptr;
  const Node* from = nullptr;  ///< Null when nobody had it.
  const Node* to = nullptr;
  std::string reason;
};

/// Told what happens inside a tick, in order.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void onStatus(const Node& node, Status from, Status to) = 0;
  virtual void onSwitch(const Switch& change) = 0;
  /// Why a node is about to fail.
  virtual void onFailure(const Node& node, std::string_view reason) = 0;
};

/// What a tick hands down the tree; whoever owns the leaves derives from it to hand down more.
class TickContext {
 public:
  TickContext() = default;
  explicit TickContext(std::int64_t now) : now_ns(now) {}
  TickContext(const TickContext&) = default;
  TickContext& operator=(const TickContext&) = default;
  virtual ~TickContext() = default;

  std::int64_t now_ns = 0;       ///< Must not go back between ticks.
  Observer* observer = nullptr;  ///< May be null.
};

class Node {
 public:
  explicit Node(const NodeSetup& setup) : name_(setup.name) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Starts or goes on. Returns kRunning, kSuccess, kFailure or kSkipped.
  Status tick(TickContext& context);
  /// Asked each tick until it returns kReleased: lets go and keeps its progress.
  Release suspend(TickContext& context);
  /// Asked each tick until it returns kReleased: lets go and forgets; it and all below are then IDLE.
  Release halt(TickContext& context);

  /// Would a tick now answer something other than SKIPPED? Changes nothing. Whatever is under way always wants.
  bool wants(const TickContext& context) const { return isActive(status_) || onAsked(context); }
  /// Why it wants the vehicle, for people; may be empty.
  virtual std::string reason(const TickContext& context) const;

  /// Shown as SKIPPED, for a node that was asked and does not want. Only for one that is not under way.
  void markSkipped(TickContext& context) { setStatus(context, Status::kSkipped); }
  /// It and all below are IDLE, at once. Only for one that is not running: nothing is let go.
  void reset(TickContext& context);

  /// Called once when all children are there; what is wrong with the built node, or an empty string.
  virtual std::string checkBuilt() const { return {}; }

  const std::string& name() const { return name_; }
  Status status() const { return status_; }
  /// In preorder from 0, unique in its tree.
  int id() const { return id_; }
  void setId(int id) { id_ = id; }
  virtual const std::vector<std::unique_ptr<Node>>& children() const;

 protected:
  /// Before the first onTick of a new start. Everything a former run left behind is to be cleared here.
  virtual void onStart(TickContext&) {}
  /// Before the first onTick after a suspension, also after one that was not complete.
  virtual void onResume(TickContext&) {}
  virtual Status onTick(TickContext& context) = 0;
  virtual Release onSuspend(TickContext&) { return Release::kReleased; }
  virtual Release onHalt(TickContext&) { return Release::kReleased; }
  /// wants() of a node that is not under way.
  virtual bool onAsked(const TickContext&) const { return true; }

  /// Reports the reason and is FAILURE.
  Status fail(TickContext& context, std::string_view reason) const;

 private:
  enum class LettingGo : unsigned char { kNo, kSuspending, kHalting };
  void setStatus(TickContext& context, Status status);

  std::string name_;
  int id_ = -1;
  Status status_ = Status::kIdle;
  LettingGo letting_go_ = LettingGo::kNo;
};

}  // namespace swiftlet::tree
