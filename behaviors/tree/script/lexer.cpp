#include "behaviors/tree/script/lexer.hpp"

#include <algorithm>
#include <array>

namespace swiftlet::tree {
namespace {

/// Longer signs come before those that they begin with.
constexpr std::array<std::string_view, 29> kSigns = {":=", "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "&&",
                                                     "||", "..", "=",  "+",  "-",  "*",  "/",  "<",  ">",  "!",
                                                     "~",  "&",  "|",  "^",  "?",  ":",  "(",  ")",  ";"};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '@'; }
bool isHex(char c) { return isDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

template <typename Is>
std::size_t lengthOf(std::string_view text, std::size_t from, Is is) {
  std::size_t end = from;
  while (end < text.size() && is(text[end])) ++end;
  return end;
}

/// The end of the number that `text` begins with: 42, 0x2A, 3.14, 1e-3.
std::size_t numberEnd(std::string_view text) {
  if (text.starts_with("0x") || text.starts_with("0X")) return lengthOf(text, 2, isHex);
  std::size_t end = lengthOf(text, 0, isDigit);
  // Two points are the sign that joins texts.
  if (end + 1 < text.size() && text[end] == '.' && isDigit(text[end + 1])) end = lengthOf(text, end + 1, isDigit);
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const std::size_t sign = end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? 2 : 1;
    const std::size_t exponent = lengthOf(text, end + sign, isDigit);
    if (exponent > end + sign) end = exponent;
  }
  return end;
}

Token quoted(std::string_view rest, std::size_t offset) {
  const std::size_t close = rest.find(rest.front(), 1);
  if (close == std::string_view::npos) return {TokenKind::kBad, rest, offset};
  return {TokenKind::kText, rest.substr(1, close - 1), offset};
}

Token nextToken(std::string_view rest, std::size_t offset) {
  if (isDigit(rest.front())) return {TokenKind::kNumber, rest.substr(0, numberEnd(rest)), offset};
  if (isLetter(rest.front()))
    return {TokenKind::kName, rest.substr(0, lengthOf(rest, 1, [](char c) { return isLetter(c) || isDigit(c); })),
            offset};
  if (rest.front() == '\'' || rest.front() == '"') return quoted(rest, offset);
  const auto* sign = std::find_if(kSigns.begin(), kSigns.end(), [&](std::string_view known) {
    return rest[0] == known[0] && (known.size() == 1 || (rest.size() > 1 && rest[1] == known[1]));
  });
  if (sign == kSigns.end()) return {TokenKind::kBad, rest.substr(0, 1), offset};
  return {TokenKind::kSign, rest.substr(0, sign->size()), offset};
}

}  // namespace

std::vector<Token> tokensOf(std::string_view script) {
  std::vector<Token> tokens;
  tokens.reserve(script.size() / 3 + 2);
  std::size_t offset = 0;
  while (true) {
    offset = lengthOf(script, offset, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
    if (offset == script.size()) break;
    tokens.push_back(nextToken(script.substr(offset), offset));
    const std::size_t quotes = tokens.back().kind == TokenKind::kText ? 2 : 0;
    offset += tokens.back().text.size() + quotes;
  }
  tokens.push_back({TokenKind::kEnd, script.substr(script.size()), script.size()});
  return tokens;
}

}  // namespace swiftlet::tree
