#include "tests/tree/oracle.hpp"

#include <algorithm>
#include <array>

namespace swiftlet::tree::testing::oracle {
namespace {

bool isBelow(const std::string& path, const std::string& root) { return path.starts_with(root); }

template <typename Set>
void eraseBelow(Set& set, const std::string& root) {
  std::erase_if(set, [&](const auto& entry) {
    if constexpr (requires { entry.first; })
      return isBelow(entry.first, root);
    else
      return isBelow(entry, root);
  });
}

constexpr int kMost = 2;  ///< At which count a condition holds.
constexpr std::array<Status, 4> kStatuses = {Status::kSuccess, Status::kFailure, Status::kRunning, Status::kSkipped};

}  // namespace

std::string toString(Status status) {
  return std::array<std::string, 4>{"RUNNING", "SUCCESS", "FAILURE", "SKIPPED"}[static_cast<std::size_t>(status)];
}

std::string childPath(const std::string& path, std::size_t index) { return path + std::to_string(index) + "/"; }

Status Oracle::tick(const Shape& shape, const Answers& answers, std::vector<std::string>& log) {
  answers_ = &answers;
  log_ = &log;
  ++now_;
  return eval(shape, "/");
}

/// Every node: its conditions come before and after its rule, and its memory lasts while it answers RUNNING.
Status Oracle::eval(const Shape& shape, const std::string& path) {
  const bool starts = !memory_.under_way.contains(path) && bug_ != Bug::kConditionsIgnored;
  Status status = Status::kRunning;
  const bool enough = shape.condition != Condition::kNone && entry(shape.counter).value >= kMost;
  if (starts && enough && shape.condition != Condition::kNone)
    status = shape.condition == Condition::kFailureIf   ? Status::kFailure
             : shape.condition == Condition::kSuccessIf ? Status::kSuccess
                                                        : Status::kSkipped;
  else
    status = evalRule(shape, path);
  if (status == Status::kSuccess && shape.counts) write(shape.counter, entry(shape.counter).value + 1.0);
  if (status == Status::kRunning)
    memory_.under_way.insert(path);
  else
    forget(path);
  return status;
}

Status Oracle::evalRule(const Shape& shape, const std::string& path) {
  Status status = Status::kFailure;
  if (shape.type == "Leaf") status = evalLeaf(shape, path);
  if (shape.type == "SequenceWithMemory") status = evalWithMemory(shape, path);
  if (shape.type == "ParallelAll") status = evalParallelAll(shape, path);
  if (shape.type == "IfThenElse") status = evalChoice(shape, path, false);
  if (shape.type == "WhileDoElse") status = evalChoice(shape, path, true);
  if (shape.type == "TryCatch") status = evalTryCatch(shape, path);
  if (shape.type == "RunOnce") status = evalOnce(shape, path);
  if (shape.type == "AsyncSequence") status = evalChain(shape, path, Status::kSuccess);
  if (shape.type == "AsyncFallback") status = evalChain(shape, path, Status::kFailure);
  if (shape.type == "Sequence") status = evalChain(shape, path, Status::kSuccess);
  if (shape.type == "Fallback") status = evalChain(shape, path, Status::kFailure);
  if (shape.type == "ReactiveSequence") status = evalReactive(shape, path, Status::kSuccess);
  if (shape.type == "ReactiveFallback") status = evalReactive(shape, path, Status::kFailure);
  if (shape.type == "Parallel") status = evalParallel(shape, path);
  if (shape.type == "Repeat") status = evalLoop(shape, path, Status::kSuccess);
  if (shape.type == "RetryUntilSuccessful") status = evalLoop(shape, path, Status::kFailure);
  if (shape.type == "Priority") status = evalPriority(shape, path);
  if (shape.type == "KeepRunningUntilFailure") {
    status = eval(shape.children[0], childPath(path, 0));
    if (status != Status::kFailure) status = Status::kRunning;
  }
  if (shape.type == "Inverter" || shape.type.starts_with("Force")) {
    status = eval(shape.children[0], childPath(path, 0));
    const bool ended = status == Status::kSuccess || status == Status::kFailure;
    if (ended && shape.type == "Inverter") status = status == Status::kSuccess ? Status::kFailure : Status::kSuccess;
    if (ended && shape.type == "ForceSuccess") status = Status::kSuccess;
    if (ended && shape.type == "ForceFailure") status = Status::kFailure;
  }
  if (shape.type == "Delay" || shape.type == "Timeout" || shape.type == "Sleep") status = evalTimed(shape, path);
  if (shape.type.starts_with("Loop")) status = evalQueue(shape, path);
  if (shape.type.starts_with("Switch")) status = evalSwitch(shape, path);
  if (shape.type.find("Update") != std::string::npos) status = evalUpdated(shape, path);
  if (shape.type == "SubTree") status = evalSubTree(shape, path);
  if (shape.type == "Precondition") {
    const bool runs = shape.number > 0 || memory_.under_way.contains(childPath(path, 0));
    status =
        runs ? eval(shape.children[0], childPath(path, 0)) : kStatuses[static_cast<std::size_t>(shape.number2) % 4];
  }
  if (shape.type.starts_with("Zero") || shape.type == "Touch") status = evalScript(shape);
  return status;
}

/// A clock stands still while its node is suspended.
Status Oracle::evalTimed(const Shape& shape, const std::string& path) {
  int& began = memory_.number.try_emplace(path, now_).first->second;
  if (const auto suspended = memory_.suspended.find(path); suspended != memory_.suspended.end()) {
    began += now_ - suspended->second;
    memory_.suspended.erase(suspended);
  }
  const bool over = (now_ - began) * (bug_ == Bug::kClockRunsTwice ? 2 : 1) >= shape.number;
  if (shape.type == "Sleep") return over ? Status::kSuccess : Status::kRunning;
  const std::string child = childPath(path, 0);
  if (shape.type == "Delay")
    return over || memory_.under_way.contains(child) ? eval(shape.children[0], child) : Status::kRunning;
  return shape.number > 0 && over ? Status::kFailure : eval(shape.children[0], child);
}

Status Oracle::evalLeaf(const Shape& shape, const std::string& path) {
  const bool active = memory_.under_way.contains(path);
  const Status answer = (*answers_)[static_cast<std::size_t>(shape.leaf)];
  if (!active && answer == Status::kSkipped) return Status::kSkipped;
  const bool resumed = memory_.suspended.erase(path) > 0;
  log_->push_back((active ? resumed ? "resume " : "" : "start ") + std::string(1, static_cast<char>('A' + shape.leaf)));
  return answer == Status::kSkipped ? Status::kRunning : answer;
}

Status Oracle::evalChain(const Shape& shape, const std::string& path, Status goes_on) {
  int& position = memory_.number[path];
  int& skipped = memory_.number[path + "skipped"];
  if (bug_ == Bug::kSequenceRestarts && goes_on == Status::kSuccess) position = skipped = 0;
  for (; position < static_cast<int>(shape.children.size()); ++position) {
    const auto i = static_cast<std::size_t>(position);
    const bool fresh = !memory_.under_way.contains(childPath(path, i));
    const Status status = eval(shape.children[i], childPath(path, i));
    if (status == Status::kSkipped)
      ++skipped;
    else if (status != goes_on)
      return status;
    else if (shape.type.starts_with("Async") && fresh && i + 1 < shape.children.size())
      return ++position, Status::kRunning;
  }
  return skipped == static_cast<int>(shape.children.size()) ? Status::kSkipped : goes_on;
}

Status Oracle::evalReactive(const Shape& shape, const std::string& path, Status goes_on) {
  bool all_skipped = true;
  for (std::size_t i = 0; i < shape.children.size(); ++i) {
    const std::string child = childPath(path, i);
    if (bug_ == Bug::kReactiveRemembers && memory_.ended.contains(child)) continue;
    const Status status = eval(shape.children[i], child);
    if (bug_ == Bug::kReactiveRemembers && status == goes_on) memory_.ended[child] = status;
    all_skipped = all_skipped && status == Status::kSkipped;
    if (status == Status::kSkipped || status == goes_on) continue;
    for (std::size_t other = 0; other < shape.children.size(); ++other)
      if (other != i) forget(childPath(path, other));
    return status;
  }
  return all_skipped ? Status::kSkipped : goes_on;
}

Status Oracle::evalParallel(const Shape& shape, const std::string& path) {
  const int all = static_cast<int>(shape.children.size());
  const int needed = std::max(0, shape.number < 0 ? all + shape.number + 1 : shape.number);
  const int bearable = std::max(0, shape.number2 < 0 ? all + shape.number2 + 1 : shape.number2);
  int skipped = 0;
  for (int i = 0; i < all; ++i) {
    const std::string child = childPath(path, static_cast<std::size_t>(i));
    if (!memory_.ended.contains(child)) {
      const Status status = eval(shape.children[static_cast<std::size_t>(i)], child);
      if (status == Status::kSkipped) ++skipped;
      if (status == Status::kSuccess || status == Status::kFailure) memory_.ended[child] = status;
    }
    if (skipped == i + 1) continue;
    int successes = 0, failures = 0;
    for (int k = 0; k < all; ++k) {
      const auto ended = memory_.ended.find(childPath(path, static_cast<std::size_t>(k)));
      if (ended == memory_.ended.end()) continue;
      ++(ended->second == Status::kSuccess ? successes : failures);
    }
    if (successes + (shape.number < 0 ? skipped : 0) >= needed) return Status::kSuccess;
    if (all - failures < needed || failures == bearable) return Status::kFailure;
  }
  return skipped == all ? Status::kSkipped : Status::kRunning;
}

Status Oracle::evalParallelAll(const Shape& shape, const std::string& path) {
  const std::size_t all = shape.children.size();
  std::size_t skipped = 0, failures = 0;
  bool running = false;
  for (std::size_t i = 0; i < all; ++i) {
    const std::string child = childPath(path, i);
    if (!memory_.ended.contains(child)) {
      const Status status = eval(shape.children[i], child);
      if (status == Status::kSkipped) ++skipped;
      if (status == Status::kRunning) running = true;
      if (status == Status::kSuccess || status == Status::kFailure) memory_.ended[child] = status;
    }
    const auto ended = memory_.ended.find(child);
    if (ended != memory_.ended.end() && ended->second == Status::kFailure) ++failures;
  }
  if (skipped == all) return Status::kSkipped;
  if (running) return Status::kRunning;
  const int bearable = shape.number < 0 ? static_cast<int>(all) + shape.number + 1 : shape.number;
  return static_cast<int>(failures) >= std::max(0, bearable) ? Status::kFailure : Status::kSuccess;
}

Status Oracle::evalChoice(const Shape& shape, const std::string& path, bool at_every_tick) {
  int& chosen = memory_.number[path];
  if (chosen == 0 || at_every_tick) {
    const Status condition = eval(shape.children[0], childPath(path, 0));
    if (condition == Status::kRunning) return condition;
    const bool ends = condition == Status::kSkipped || (condition == Status::kFailure && shape.children.size() == 2);
    if (ends) return condition;
    const int now = condition == Status::kSuccess ? 1 : 2;
    if (chosen != 0 && chosen != now) forget(childPath(path, static_cast<std::size_t>(chosen)));
    chosen = now;
  }
  const auto i = static_cast<std::size_t>(chosen);
  const Status status = eval(shape.children[i], childPath(path, i));
  return status == Status::kSkipped ? Status::kSuccess : status;
}

Status Oracle::evalWithMemory(const Shape& shape, const std::string& path) {
  int& position = memory_.kept[path];
  int& skipped = memory_.number[path + "skipped"];
  for (; position < static_cast<int>(shape.children.size()); ++position) {
    const auto i = static_cast<std::size_t>(position);
    const bool fresh = !memory_.under_way.contains(childPath(path, i));
    const Status status = eval(shape.children[i], childPath(path, i));
    if (status == Status::kSkipped) {
      ++skipped;
    } else if (status != Status::kSuccess) {
      if (bug_ == Bug::kMemoryForgets && status == Status::kFailure) position = skipped = 0;
      return status;
    } else if (fresh && i + 1 < shape.children.size()) {
      return ++position, Status::kRunning;
    }
  }
  const bool all_skipped = skipped == static_cast<int>(shape.children.size());
  position = skipped = 0;
  return all_skipped ? Status::kSkipped : Status::kSuccess;
}

Status Oracle::evalTryCatch(const Shape& shape, const std::string& path) {
  const int tried = static_cast<int>(shape.children.size()) - 1;
  int& position = memory_.number[path];
  int& skipped = memory_.number[path + "skipped"];
  for (; position < tried; ++position) {
    const auto i = static_cast<std::size_t>(position);
    const Status status = eval(shape.children[i], childPath(path, i));
    if (status == Status::kRunning) return status;
    if (status == Status::kFailure) position = tried;  // From now on only the last child.
    if (status == Status::kSkipped) ++skipped;
    if (status == Status::kFailure) break;
    if (position + 1 == tried) return skipped == tried ? Status::kSkipped : Status::kSuccess;
  }
  const auto last = static_cast<std::size_t>(tried);
  return eval(shape.children[last], childPath(path, last)) == Status::kRunning ? Status::kRunning : Status::kFailure;
}

Status Oracle::evalOnce(const Shape& shape, const std::string& path) {
  const auto ended = memory_.kept.find(path);
  if (ended != memory_.kept.end()) return shape.number > 0 ? Status::kSkipped : static_cast<Status>(ended->second);
  const Status status = eval(shape.children[0], childPath(path, 0));
  if (status == Status::kSuccess || status == Status::kFailure) memory_.kept[path] = static_cast<int>(status);
  return status;
}

Status Oracle::evalLoop(const Shape& shape, const std::string& path, Status counted) {
  int& count = memory_.number[path];
  while (shape.number == -1 || count < shape.number) {
    const bool fresh = !memory_.under_way.contains(childPath(path, 0));
    const Status status = eval(shape.children[0], childPath(path, 0));
    if (status != counted) return status;
    ++count;
    if (fresh && (shape.number == -1 || count < shape.number)) return Status::kRunning;
  }
  return counted;
}

Status Oracle::evalPriority(const Shape& shape, const std::string& path) {
  bool anything = false;
  for (std::size_t i = 0; i < shape.children.size(); ++i) {
    const std::string child = childPath(path, i);
    if (!wants(shape.children[i], child)) continue;
    for (std::size_t lower = i + 1; lower < shape.children.size(); ++lower) {
      if (bug_ == Bug::kPriorityResets)
        forget(childPath(path, lower));
      else
        suspendBelow(childPath(path, lower));
    }
    const Status status = eval(shape.children[i], child);
    if (status == Status::kRunning || status == Status::kFailure) return status;
    anything = anything || status == Status::kSuccess;
  }
  return anything ? Status::kSuccess : Status::kSkipped;
}

bool Oracle::wants(const Shape& shape, const std::string& path) {
  if (memory_.under_way.contains(path)) return true;
  Oracle trial = *this;
  std::vector<std::string> unheard;
  trial.log_ = &unheard;
  return trial.eval(shape, path) != Status::kSkipped;
}

void Oracle::forget(const std::string& path) {
  eraseBelow(memory_.under_way, path);
  eraseBelow(memory_.suspended, path);
  eraseBelow(memory_.number, path);
  // A parallel's list of ended children belongs to the parallel, not to the child.
  std::erase_if(memory_.ended, [&](const auto& entry) { return entry.first != path && isBelow(entry.first, path); });
}

void Oracle::suspendBelow(const std::string& path) {
  for (const std::string& active : memory_.under_way)
    if (isBelow(active, path)) memory_.suspended.emplace(active, now_);
}

}  // namespace swiftlet::tree::testing::oracle
