#include "apps/show.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>

#include "common/printable.hpp"

namespace swiftlet::apps {
namespace {

/// JSON escapes characters below 0x20, but not DEL and the C1 characters (UTF-8: C2 80 to C2 9F).
std::string withoutControls(const std::string& json) {
  std::string result;
  result.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto byte = static_cast<unsigned char>(json[i]);
    const unsigned char next = i + 1 < json.size() ? static_cast<unsigned char>(json[i + 1]) : 0;
    if (byte == 0x7F) {
      result += "\\u007f";
    } else if (byte == 0xC2 && next >= 0x80 && next < 0xA0) {
      result += fmt::format("\\u00{:02x}", next);
      ++i;
    } else {
      result += json[i];
    }
  }
  return result;
}

}  // namespace

void outliveReaders() { std::signal(SIGPIPE, SIG_IGN); }

void showStyled(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  if (std::fflush(stdout) != 0 && errno == EPIPE) std::clearerr(stdout);
}

void show(const std::string& text) { showStyled(common::printableLines(text)); }

void showJson(const std::string& text) { showStyled(withoutControls(text)); }

void showError(const std::string& text) { std::fputs(common::printableLines(text).c_str(), stderr); }

void showNotes(const std::vector<common::Problem>& notes) {
  for (const common::Problem& note : notes) showError("note: " + toString(note) + "\n");
}

std::string lineOf(tree::Problem problem, bool warning) {
  if (warning) problem.element = "warning" + (problem.element.empty() ? "" : ": " + problem.element);
  return common::printable(toString(problem) + (problem.path.empty() ? "" : " [" + problem.path + "]")) + "\n";
}

}  // namespace swiftlet::apps
