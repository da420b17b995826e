// Compiles the text of a script: recursive descent over its tokens, one function for each level of precedence.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "behaviors/tree/script/lexer.hpp"
#include "behaviors/tree/script/program.hpp"

namespace swiftlet::tree {

class ScriptCompiler {
 public:
  ScriptCompiler(std::string_view text, const Constants& constants)
      : text_(text), constants_(constants), tokens_(tokensOf(text)) {}

  ProgramResult compile();

 private:
  using Op = ScriptProgram::Op;
  using Index = std::uint32_t;
  using Signs = std::initializer_list<std::pair<std::string_view, Op>>;

  Index statement();
  Index choice();
  Index logic(std::size_t level);
  Index comparison();
  Index binary(std::size_t level);
  Index unary();
  Index operand();
  Index number(const Token& token);
  Index name(const Token& token);

  Index add(ScriptProgram::Expression expression);
  Index constant(Value value);
  std::size_t entry(std::string_view name, bool read);
  Index assignment(std::string_view name, std::string_view sign);
  void recordWrite(std::size_t entry, bool makes, const ScriptProgram::Expression& value);

  const Token& next() const { return tokens_[position_]; }
  /// Signs have one or two characters.
  bool at(std::string_view sign) const {
    const std::string_view text = next().text;
    return next().kind == TokenKind::kSign && text.size() == sign.size() && text[0] == sign[0] &&
           (sign.size() == 1 || text[1] == sign[1]);
  }
  bool take(std::string_view sign);
  /// Keeps the first problem and ends the text, so that every function above returns.
  Index fail(const Token& token, std::string_view expected);

  std::string_view text_;
  const Constants& constants_;
  std::vector<Token> tokens_;
  std::size_t position_ = 0;
  int depth_ = 0;
  std::string problem_;
  ScriptProgram program_;
};

}  // namespace swiftlet::tree
