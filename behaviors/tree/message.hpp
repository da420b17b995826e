// What is said of a tree file: a name that programs and tests ask for, and a text for people.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace swiftlet::tree {

class Message {
 public:
  /// The name is a literal and says the kind, in kebab case with the subject first: "tree.unknown-node". A name has one
  /// text.
  template <typename... A>
  Message(std::string_view name, fmt::format_string<A...> text, A&&... args)
      : name_(name), text_(fmt::format(text, std::forward<A>(args)...)) {}

  std::string_view name() const { return name_; }
  const std::string& text() const { return text_; }
  /// What is to be added in this case: where a value was read, a character that cannot be seen.
  void append(std::string_view remark) { text_ += remark; }

  bool operator==(const Message&) const = default;

 private:
  std::string_view name_;
  std::string text_;
};

}  // namespace swiftlet::tree
