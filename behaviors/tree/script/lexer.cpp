#include "behaviors/tree/script/lexer.hpp"

#include "behaviors/tree/utf8.hpp"

namespace swiftlet::tree {
namespace {

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

/// Length of the sign that `text` begins with; 0 if it begins with no sign.
std::size_t signLength(std::string_view text) {
  constexpr std::string_view kSingle = "=+-*/<>!~&|^?:();", kBeforeEqual = ":+-*/=!<>", kDoubled = "&|.";
  const char first = text[0], second = text.size() > 1 ? text[1] : '\0';
  const std::string_view pairs = second == '=' ? kBeforeEqual : second == first ? kDoubled : std::string_view();
  if (pairs.find(first) != std::string_view::npos) return 2;
  return kSingle.find(first) == std::string_view::npos ? 0 : 1;
}

Token quoted(std::string_view rest) {
  const std::size_t close = rest.find(rest.front(), 1);
  if (close == std::string_view::npos) return {TokenKind::kBad, rest};
  return {TokenKind::kText, rest.substr(1, close - 1)};
}

Token nextToken(std::string_view rest) {
  if (isDigit(rest.front())) return {TokenKind::kNumber, rest.substr(0, numberEnd(rest))};
  if (isLetter(rest.front()))
    return {TokenKind::kName, rest.substr(0, lengthOf(rest, 1, [](char c) { return isLetter(c) || isDigit(c); }))};
  if (rest.front() == '\'' || rest.front() == '"') return quoted(rest);
  const std::size_t length = signLength(rest);
  if (length > 0) return {TokenKind::kSign, rest.substr(0, length)};
  return {TokenKind::kBad, rest.substr(0, lengthOf(rest, 1, continuesCharacter))};
}

}  // namespace

void readTokens(std::string_view script, std::vector<Token>& tokens) {
  tokens.clear();
  std::size_t offset = 0;
  while (true) {
    offset = lengthOf(script, offset, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
    if (offset == script.size()) break;
    tokens.push_back(nextToken(script.substr(offset)));
    const std::size_t quotes = tokens.back().kind == TokenKind::kText ? 2 : 0;
    offset += tokens.back().text.size() + quotes;
  }
  tokens.push_back({TokenKind::kEnd, script.substr(script.size())});
}

bool isScriptName(std::string_view text) {
  const auto goesOn = [](char c) { return isLetter(c) || isDigit(c); };
  return !text.empty() && isLetter(text.front()) && lengthOf(text, 1, goesOn) == text.size() && text != "true" &&
         text != "false";
}

}  // namespace swiftlet::tree
