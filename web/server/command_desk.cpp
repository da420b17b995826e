#include "web/server/command_desk.hpp"

namespace swiftlet::web {
namespace {

/// Commands without an answer yet. More than operators give by hand: a flood is refused.
constexpr std::size_t kMostWaiting = 64;

}  // namespace

bool CommandDesk::give(const Kind& kind, Answer answer) {
  if (waiting_.size() >= kMostWaiting) return false;
  const std::uint64_t id = ++last_id_;
  waiting_.emplace(id, Waiting{std::move(answer), patience_});
  commands_.push({id, kind});
  return true;
}

void CommandDesk::tick() {
  for (const common::CommandResult& result : results_.takeAll()) {
    const auto it = waiting_.find(result.id);
    if (it == waiting_.end()) continue;
    const Answer answer = std::move(it->second.answer);
    waiting_.erase(it);
    answer(result.id, result);
  }
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    if (--it->second.patience > 0) {
      ++it;
      continue;
    }
    const std::uint64_t id = it->first;
    const Answer answer = std::move(it->second.answer);
    it = waiting_.erase(it);
    answer(id, std::nullopt);
  }
}

}  // namespace swiftlet::web
