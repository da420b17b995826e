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
// Releasing a node may take several ticks: the parent calls suspend() or halt() once a tick until the answer is
// kReleased, and gives no other node control before. suspend() keeps the progress, halt() drops it. A node that is
// ticked while it is being suspended continues (onResume); one that is being halted finishes that first.
//
// A node that throws an exception is FAILURE with that reason, and counts as released; the tree goes on as after any
// failure.
//
// Scripted conditions of the file (see conditions.hpp) come before and after the node's own rule.
//
// Each tick brings the time; no node reads a clock. Single-threaded.
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

/// Another child of a Priority takes control, or is about to.
struct Switch {
  enum class Kind : unsigned char {
    kLetsGo,  ///< `from` is being released for `to`; it may take several ticks.
    kTakes,   ///< `to` is in control from this tick on.
    kKeeps,   ///< `to` (which is also `from`) continues after all, because the other child would be SKIPPED now.
  };
  Kind kind = Kind::kTakes;
  const Node* priority = nullptr;
  const Node* from = nullptr;  ///< Null if no node had it.
  const Node* to = nullptr;
  std::string reason;
};

/// Receives what happens inside a tick, in order.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void onStatus(const Node& node, Status from, Status to) = 0;
  virtual void onSwitch(const Switch& change) = 0;
  /// Why a node is about to fail.
  virtual void onFailure(const Node& node, std::string_view reason) = 0;
};

/// What a tick passes down the tree. An application derives from it to pass more to its own leaves.
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
  explicit Node(const NodeSetup& setup) : name_(setup.name), conditions_(setup.conditions) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Starts or continues. Returns kRunning, kSuccess, kFailure or kSkipped.
  Status tick(TickContext& context);
  /// Called each tick until it returns kReleased: the node releases control and keeps its progress.
  Release suspend(TickContext& context);
  /// Called each tick until it returns kReleased: the node releases control and drops its progress. It and all nodes
  /// below are then IDLE.
  Release halt(TickContext& context);

  /// Whether a tick now would answer something other than SKIPPED. Changes nothing. Always true for a running
  /// node.
  bool wants(const TickContext& context) const;
  /// Why it would start, for people; may be empty.
  std::string reason(const TickContext& context) const;

  /// Shows SKIPPED for a node that was asked and would not start. Not for a running node.
  void markSkipped(TickContext& context) { setStatus(context, Status::kSkipped); }
  /// It and all nodes below become IDLE at once. Not for a running node, because nothing is released.
  void reset(TickContext& context);

  const std::string& name() const { return name_; }
  Status status() const { return status_; }
  /// Index in preorder from 0, unique in its tree.
  int id() const { return id_; }
  void setId(int id) { id_ = id; }
  virtual const std::vector<std::unique_ptr<Node>>& children() const;

 protected:
  /// Called before the first onTick of a new start. The node must clear everything that a former run left.
  virtual void onStart(TickContext&) {}
  /// Before the first onTick after a suspension, also after one that was not complete.
  virtual void onResume(TickContext&) {}
  virtual Status onTick(TickContext& context) = 0;
  virtual Release onSuspend(TickContext&) { return Release::kReleased; }
  virtual Release onHalt(TickContext&) { return Release::kReleased; }
  /// wants() for a node that is not running.
  virtual bool onAsked(const TickContext&) const { return true; }
  virtual std::string whyItWants(const TickContext&) const { return {}; }

  /// Reports the reason and returns FAILURE.
  Status fail(TickContext& context, std::string_view reason) const;

 private:
  enum class LettingGo : unsigned char { kNo, kSuspending, kHalting };
  std::optional<Status> decidedBefore(TickContext& context);
  Status followRule(TickContext& context);
  Release releasedBy(Release (Node::*ask)(TickContext&), TickContext& context);
  bool asksForVehicle(const TickContext& context) const;
  Status end(TickContext& context, Status status);
  void setStatus(TickContext& context, Status status);

  std::string name_;
  Conditions* conditions_;  ///< Null without scripted conditions.
  int id_ = -1;
  Status status_ = Status::kIdle;
  LettingGo letting_go_ = LettingGo::kNo;
};

}  // namespace swiftlet::tree
