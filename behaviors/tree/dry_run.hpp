// Ticks a tree without a vehicle: a script gives the answers of its leaves.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "behaviors/tree/outcome_script.hpp"
#include "behaviors/tree/parse_options.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::tree {

struct DryRunTick {
  std::int64_t now_ns = 0;
  Status answer = Status::kIdle;
  /// What happened, in order: "Main/Sequence/Land: RUNNING -> SUCCESS", a switch of a Priority, a failure with its
  /// reason.
  std::vector<std::string> events;
};

/// Leaves of `base` that are not of the engine are stand-ins with the ports of their types (mocks.hpp). With `mocks`,
/// types that `base` does not have are mocks. A leaf that the script does not name is SKIPPED if it can be, a condition
/// that it does not name is false, any other leaf SUCCESS. The engine's own leaves (Script, Sleep ...) do what they
/// always do.
class DryRun {
 public:
  DryRun(const std::string& path, const Registry& base, OutcomeScript script, bool mocks, ParseOptions options = {});
  ~DryRun();
  DryRun(DryRun&&) noexcept;
  DryRun& operator=(DryRun&&) noexcept;

  /// Of the file and of the script. With one there are no ticks.
  const std::vector<Problem>& problems() const;
  /// Leaves that the script does not name, and what they answer: "Land: SUCCESS".
  const std::vector<std::string>& unscripted() const;
  /// Ticks the tree; nothing after its first SUCCESS or FAILURE, and at the limit of the script.
  std::optional<DryRunTick> tick();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace swiftlet::tree
