// Splits a script into words.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace swiftlet::tree {

enum class TokenKind : unsigned char { kNumber, kText, kName, kSign, kEnd, kBad };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;   ///< As written; of kText without the quotes.
  std::size_t offset = 0;  ///< In the script.
};

/// The tokens of a script, the last of which is kEnd. A character or a text without an end that is no token gives kBad
/// in front of it.
std::vector<Token> tokensOf(std::string_view script);

}  // namespace swiftlet::tree
