// A tree of another program, ticked with mocks.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::tree::testing {

/// A file whose mocks answer what the test says; those that it does not name are SUCCESS.
class MockedTree {
 public:
  explicit MockedTree(const std::string& path, const Registry& base = Registry::standard())
      : mocked_(withMocks(path, base, {},
                          [this](const Node& mock, bool) {
                            const auto found = answers_.find(mock.name());
                            return found == answers_.end() ? Status::kSuccess : found->second;
                          })),
        parsed_(parseFile(path, mocked_.registry, mocked_.options)) {}

  MockedTree& says(const std::string& leaf, Status status) {
    answers_[leaf] = status;
    return *this;
  }
  /// A tenth of a second passes: "RUNNING: Sequence RUNNING, A SUCCESS, B RUNNING".
  std::string tick() {
    if (!parsed_.tree) return toString(parsed_.problems);
    now_ns_ += 100'000'000;
    TickContext context(now_ns_);
    std::string text = toString(parsed_.tree->tick(context));
    for (const NodeView& node : parsed_.tree->view())
      text += (node.id == 0 ? ": " : ", ") + node.name + " " + toString(node.status);
    return text;
  }
  const std::vector<Mock>& mocks() const { return mocked_.mocks; }
  const std::vector<Problem>& problems() const { return parsed_.problems; }
  const std::vector<Problem>& warnings() const { return parsed_.warnings; }

 private:
  std::map<std::string, Status> answers_;
  MockedRegistry mocked_;
  ParseResult parsed_;
  std::int64_t now_ns_ = 0;
};

}  // namespace swiftlet::tree::testing
