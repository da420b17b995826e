// What is said of a problem: a name for programs and tests, and a text for people.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace swiftlet::common {

/// What is wrong, by a name that programs and tests ask for and a text for people. All of them are listed in
/// docs/messages.md, which scripts/messages writes.
class Message {
 public:
  /// Nothing is said.
  Message() = default;
  /// `name` is a literal: the room's subject and the kind of problem, "map.no-image". A kind has one name and one text.
  template <typename... Values>
  Message(std::string_view name, fmt::format_string<Values...> text, Values&&... values)
      : name_(name), text_(fmt::format(text, std::forward<Values>(values)...)) {}

  std::string_view name() const { return name_; }
  const std::string& text() const { return text_; }

  /// Says more, under the same name.
  Message& operator+=(std::string_view more) {
    text_ += more;
    return *this;
  }
  /// The same with more text before it.
  Message behind(std::string_view more) const {
    Message message = *this;
    message.text_.insert(0, more);
    return message;
  }

 private:
  std::string_view name_;
  std::string text_;
};

}  // namespace swiftlet::common
