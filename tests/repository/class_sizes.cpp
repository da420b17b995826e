#include "tests/repository/class_sizes.hpp"

#include <algorithm>
#include <map>
#include <regex>

namespace swiftlet::repository {
namespace {

/// Without comments, characters and the contents of strings.
std::string codeOf(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (text.compare(i, 2, "/*") == 0) {
      i = std::min(text.find("*/", i), text.size() - 2) + 1;
    } else if (text[i] == '\'' && i + 2 < text.size() && (text[i + 2] == '\'' || text[i + 1] == '\\')) {
      i = text.find('\'', i + (text[i + 1] == '\\' ? 3 : 2));  // Not the mark between digits of a number.
    } else if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
    } else {
      code += text[i];
    }
  }
  return code;
}

/// The position of the bracket that closes the one at `open`.
std::size_t closing(const std::string& code, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < code.size(); ++i) {
    if (code[i] == '{') ++depth;
    if (code[i] == '}' && --depth == 0) return i;
  }
  return code.size() - 1;
}

/// One declaration of a class, without what is in its braces, and what is in the first of them.
struct Declaration {
  std::string text, body;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \n\t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \n\t") - first + 1);
}

/// A body that ends a declaration without a semicolon is that of a function.
std::vector<Declaration> declarationsOf(const std::string& body) {
  static const std::regex kAccess("^(public|private|protected)\\s*:");
  static const std::regex kFunction("\\)[\\s\\w:&()<>,.*-]*$");
  std::vector<Declaration> all;
  Declaration now;
  const auto end = [&] {
    now.text = trimmed(now.text);
    if (!now.text.empty()) all.push_back(now);
    now = {};
  };
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] == ';') {
      end();
    } else if (body[i] == ':' && std::regex_search(trimmed(now.text) + ":", kAccess) &&
               (i + 1 >= body.size() || body[i + 1] != ':')) {
      now.text += ':';
      end();
    } else if (body[i] == '{') {
      const std::size_t close = closing(body, i);
      if (now.body.empty()) now.body = body.substr(i + 1, close - i - 1);
      const bool function = std::regex_search(trimmed(now.text), kFunction) && now.text.find('=') == std::string::npos;
      const bool continues =
          body.find_first_not_of(" \n\t", close + 1) != std::string::npos &&
          std::string(",{").find(body[body.find_first_not_of(" \n\t", close + 1)]) != std::string::npos;
      now.text += "{}";
      i = close;
      if (function && !continues) end();
    } else {
      now.text += body[i];
    }
  }
  end();
  return all;
}

/// Names of templates with what is in their brackets left out, so that commas and brackets are those of declarations.
std::string withoutArguments(std::string text) {
  static const std::regex kArguments("<[^<>]*>");
  for (std::string before; before != text;) {
    before = text;
    text = std::regex_replace(text, kArguments, "");
  }
  return text;
}

ClassSize sizeOf(const std::string& name, bool is_struct, const std::string& body) {
  static const std::regex kNested("^(?:class|struct) (\\w+)[^;(]*\\{\\}");
  static const std::regex kLeftOut(
      "^(using|friend|typedef|static_assert|template|enum|static constexpr|static const |"
      "inline static|struct \\w+$|class \\w+$)");
  ClassSize size{name, is_struct, 0, 0};
  std::map<std::string, int> nested;
  bool is_public = is_struct;
  for (const Declaration& one : declarationsOf(body)) {
    std::smatch match;
    if (one.text.ends_with(":") && one.text.find(' ') == std::string::npos) {
      is_public = one.text == "public:";
    } else if (std::regex_search(one.text, match, kNested)) {
      nested[match[1]] = sizeOf(match[1], true, one.body).members;
    } else if (std::regex_search(one.text, kLeftOut)) {
      continue;
    } else if (const std::string plain = withoutArguments(one.text.substr(0, one.text.find(" = ")));
               plain.find('(') != std::string::npos) {
      const bool special = plain.find("operator") != std::string::npos || plain.find("~") != std::string::npos ||
                           std::regex_search(plain, std::regex("(^|\\s)" + name + "\\("));
      size.public_methods += is_public && !special ? 1 : 0;
    } else {
      static const std::regex kInitialized(" = [^,]*");
      const std::string names = std::regex_replace(withoutArguments(one.text), kInitialized, "");
      int members = static_cast<int>(std::ranges::count(names, ',')) + 1;
      // What a container has many of is not a part of the class; what it holds itself is.
      for (const auto& [type, inner] : nested)
        if (!is_struct &&
            std::regex_search(one.text, std::regex("^(?:mutable |const )*(?:std::optional<)?" + type + "\\b")))
          members *= inner;
      size.members += members;
    }
  }
  return size;
}

}  // namespace

std::vector<ClassSize> classSizes(const std::string& header) {
  static const std::regex kClass("(^|\\n)(class|struct) (\\w+)( final)?( :[^{;]*)? \\{");
  const std::string code = codeOf(header);
  std::vector<ClassSize> all;
  for (std::sregex_iterator it(code.begin(), code.end(), kClass), none; it != none; ++it) {
    const std::size_t open = static_cast<std::size_t>(it->position() + it->length()) - 1;
    all.push_back(sizeOf((*it)[3], (*it)[2] == "struct", code.substr(open + 1, closing(code, open) - open - 1)));
  }
  return all;
}

}  // namespace swiftlet::repository
