#include "interfaces/links/groot/groot_monitor.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/hash.hpp"
#include "interfaces/links/groot/groot_xml.hpp"

namespace swiftlet::interfaces {
namespace {

constexpr std::size_t kHeaderBytes = 6;
constexpr char kProtocol = 2;
/// Nine bytes each: an hour of a busy tree. What comes later is not recorded.
constexpr std::size_t kMostTransitionBytes = 9 * std::size_t{1'000'000};

template <typename Number>
void appendBytes(std::string& bytes, Number number, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    bytes += static_cast<char>((static_cast<std::uint64_t>(number) >> (8U * i)) & 0xFFU);
}

std::uint8_t codeOf(std::string_view status) {
  constexpr std::array<std::string_view, 5> kCodes = {"IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED"};
  if (status == "SUSPENDED") return 11;
  const auto found = std::find(kCodes.begin(), kCodes.end(), status);
  return found == kCodes.end() ? 0 : static_cast<std::uint8_t>(found - kCodes.begin());
}

bool isSameNode(const common::TreeNodeView& a, const common::TreeNodeView& b) {
  return a.parent == b.parent && a.name == b.name && a.type == b.type;
}

std::vector<std::string> refused(const std::string& reason) { return {"error", reason}; }

std::int64_t microseconds(common::Time time) { return time.nanoseconds() / 1000; }

}  // namespace

void GrootMonitor::update(const std::string& name, const common::TreeView& tree, common::Time stamp) {
  stamp_ = stamp;
  const bool same = std::equal(tree.begin(), tree.end(), tree_.begin(), tree_.end(), isSameNode);
  if (!same || name_ != name) {
    name_ = name;
    replaceTree(tree);
  }
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i] == tree_[i]) continue;
    if (tree[i].status != tree_[i].status) changeStatus(i, tree[i], stamp);
    tree_[i] = tree[i];
  }
}

void GrootMonitor::replaceTree(const common::TreeView& tree) {
  tree_ = tree;
  statuses_.clear();
  for (const common::TreeNodeView& node : tree) statuses_.push_back(codeOf(node.status));
  xml_ = grootXml(name_, tree, models_);
  identity_.clear();
  appendBytes(identity_, common::fnv1a(xml_), 8);
  appendBytes(identity_, common::fnv1a("tree of " + xml_), 8);
  transitions_.clear();
}

void GrootMonitor::changeStatus(std::size_t node, const common::TreeNodeView& next, common::Time stamp) {
  const std::uint8_t before = statuses_[node] % 10, now = codeOf(next.status);
  statuses_[node] = now == 0 && before != 0 ? static_cast<std::uint8_t>(10 + before) : now;
  if (!recording_ || transitions_.size() >= kMostTransitionBytes) return;
  appendBytes(transitions_, microseconds(stamp) - microseconds(recording_since_), 6);
  appendBytes(transitions_, node + 1, 2);
  appendBytes(transitions_, statuses_[node] % 10, 1);
}

std::vector<std::string> GrootMonitor::answer(const std::vector<std::string>& request) {
  if (request.empty() || request[0].size() != kHeaderBytes) return refused("the header of a request has 6 bytes");
  if (request[0][0] != kProtocol) return refused("this is version 2 of the protocol");
  std::vector<std::string> reply = {request[0] + identity_};
  const auto second = [&]() { return request.size() > 1 ? request[1] : std::string(); };
  switch (request[0][1]) {
    case 'T':
      reply.push_back(xml_);
      return reply;
    case 'S':
      reply.push_back(statusBytes());
      return reply;
    case 'B':
      reply.push_back(blackboards(second()));
      return reply;
    case 'D':
      reply.emplace_back("[]");
      return reply;
    case 'A':
    case 'X':
      return reply;
    case 'r':
      if (second() != "start" && second() != "stop") return refused("expected `start` or `stop`");
      record(second() == "start");
      if (recording_) reply.push_back(std::to_string(microseconds(recording_since_)));
      return reply;
    case 't':
      reply.push_back(std::exchange(transitions_, {}));
      return reply;
    case 'I':
    case 'R':
    case 'U':
      return refused("a flight has no breakpoints");
    default:
      return refused("unknown request");
  }
}

std::string GrootMonitor::statusBytes() const {
  std::string bytes;
  for (std::size_t i = 0; i < statuses_.size(); ++i) {
    appendBytes(bytes, i + 1, 2);
    appendBytes(bytes, statuses_[i], 1);
  }
  return bytes;
}

/// The entries that the ports of a tree's nodes are bound to, and that are set.
std::string GrootMonitor::blackboards(const std::string& names) const {
  const std::vector<std::string> blackboards = grootBlackboards(name_, tree_);
  nlohmann::json all = nlohmann::json::object();
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(';', begin), names.size());
    const std::string wanted = names.substr(begin, end - begin);
    begin = end + 1;
    if (std::find(blackboards.begin(), blackboards.end(), wanted) == blackboards.end()) continue;
    nlohmann::json& entries = all[wanted] = nlohmann::json::object();
    for (std::size_t i = 0; i < tree_.size(); ++i)
      for (const common::TreePortView& port : tree_[i].ports)
        if (blackboards[i] == wanted && !port.entry.empty() && port.value) entries[port.entry] = *port.value;
  }
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_msgpack(all);
  return {bytes.begin(), bytes.end()};
}

void GrootMonitor::record(bool on) {
  recording_ = on;
  if (!on) return;
  recording_since_ = stamp_;
  transitions_.clear();
}

}  // namespace swiftlet::interfaces
