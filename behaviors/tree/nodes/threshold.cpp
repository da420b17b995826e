#include "behaviors/tree/nodes/threshold.hpp"

#include <algorithm>

namespace swiftlet::tree {

std::size_t threshold(std::int64_t asked, std::size_t children) {
  const auto all = static_cast<std::int64_t>(children);
  return static_cast<std::size_t>(std::max<std::int64_t>(0, asked < 0 ? all + asked + 1 : asked));
}

std::optional<Message> tooMany(std::string_view port, const std::optional<std::int64_t>& asked, std::size_t children) {
  if (!asked || *asked <= static_cast<std::int64_t>(children)) return std::nullopt;
  return Message("tree.count-unreachable", "{} is {}, but it has only {} {}", port, *asked, children,
                 children == 1 ? "child" : "children");
}

}  // namespace swiftlet::tree
