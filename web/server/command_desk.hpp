// Hands commands over and brings each answer back to its sender. Runs on the thread of the event loop.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "common/command.hpp"
#include "common/mailbox.hpp"

namespace swiftlet::web {

class CommandDesk {
 public:
  using Kind = decltype(common::OperatorCommand::kind);
  /// nullopt: no answer came in time. The command may still be executed.
  using Answer = std::function<void(std::uint64_t id, const std::optional<common::CommandResult>& result)>;

  /// `patience` in ticks.
  CommandDesk(common::LosslessQueue<common::OperatorCommand>& commands,
              common::LosslessQueue<common::CommandResult>& results, int patience)
      : commands_(commands), results_(results), patience_(patience) {}

  /// False if too many commands wait for their answer; the command is not handed over then.
  [[nodiscard]] bool give(const Kind& kind, Answer answer);
  /// Delivers the answers that have come.
  void tick();
  bool waiting() const { return !waiting_.empty(); }

 private:
  struct Waiting {
    Answer answer;
    int patience;
  };

  common::LosslessQueue<common::OperatorCommand>& commands_;
  common::LosslessQueue<common::CommandResult>& results_;
  int patience_;
  std::uint64_t last_id_ = 0;
  std::map<std::uint64_t, Waiting> waiting_;
};

}  // namespace swiftlet::web
