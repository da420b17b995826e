// Compiles the text of a script: recursive descent over its tokens.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "behaviors/tree/message.hpp"
#include "behaviors/tree/script/lexer.hpp"
#include "behaviors/tree/script/program.hpp"

namespace swiftlet::tree {

/// Used again and again, so that its memory is.
class ScriptCompiler {
 public:
  explicit ScriptCompiler(const Constants& constants) : constants_(constants) {}

  struct Result {
    ScriptProgram program;
    std::optional<Message> problem;  ///< What is wrong with the text; nothing if it is a script.
  };
  /// Adds a script to `code`. The text must outlive the code. A text that is no script leaves code that nothing uses.
  Result compile(std::string_view text, ScriptCode& code);

 private:
  using Op = ScriptOp;
  using Index = std::uint32_t;
  using Signs = std::initializer_list<std::pair<std::string_view, Op>>;

  Index expression();
  Index choice();
  Index binary(int loosest);
  Index comparison(Index left);
  Index unary();
  Index operand();
  Index number(const Token& token);
  Index name(const Token& token);

  Index add(ScriptExpression expression);
  bool isZero(const ScriptExpression& expression) const;
  Index addBinary(Op op, Index left, Index right, std::size_t writes_before);
  void recordPairing(Op op, Index left, Index right);
  std::optional<ScriptSide> sideOf(Index operand) const;
  template <typename T>
  Index constant(T value);
  Index entry(std::string_view name, bool read);
  Index assignment(std::string_view name, std::string_view sign);
  void recordWrite(Index entry, bool makes, ScriptExpression value);

  const Token& next() const { return tokens_[position_]; }
  bool at(std::string_view sign) const { return next().isSign(sign); }
  bool take(std::string_view sign);
  /// Keeps the first problem and ends the text, so that every function above returns.
  Index fail(const Token& token, std::string_view expected);

  const Constants& constants_;
  // Of the text that is being compiled.
  std::string_view text_;
  ScriptCode* code_ = nullptr;
  std::size_t first_entry_ = 0;
  std::vector<Token> tokens_;
  std::size_t position_ = 0;
  int depth_ = 0;
  std::optional<Message> problem_;
};

}  // namespace swiftlet::tree
