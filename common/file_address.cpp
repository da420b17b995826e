#include "common/file_address.hpp"

#include <charconv>

#include "common/lower_case.hpp"

namespace swiftlet::common {

std::string percentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      decoded += static_cast<char>(code);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

std::string pathOfAddress(std::string_view name) {
  constexpr std::string_view kScheme = "file://", kThisMachine = "localhost/";
  if (lowerCase(name.substr(0, kScheme.size())) != kScheme) return std::string(name);
  name.remove_prefix(kScheme.size());
  if (name.starts_with(kThisMachine)) name.remove_prefix(kThisMachine.size() - 1);
  return percentDecoded(name);
}

}  // namespace swiftlet::common
