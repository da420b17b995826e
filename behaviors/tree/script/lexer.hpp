// Splits a script into words.
#pragma once

#include <string_view>
#include <vector>

namespace swiftlet::tree {

enum class TokenKind : unsigned char { kNumber, kText, kName, kSign, kEnd, kBad };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;  ///< As written; of kText without the quotes.

  /// Signs have one or two characters.
  bool isSign(std::string_view sign) const {
    return kind == TokenKind::kSign && text.size() == sign.size() && text[0] == sign[0] &&
           (sign.size() == 1 || text[1] == sign[1]);
  }
};

/// Replaces `tokens` by those of a script, the last of which is kEnd. A character or a text without an end that is no
/// token gives kBad in front of it.
void readTokens(std::string_view script, std::vector<Token>& tokens);

/// Whether a script reads the text as the name of an entry.
bool isScriptName(std::string_view text);

}  // namespace swiftlet::tree
