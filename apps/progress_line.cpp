#include "apps/progress_line.hpp"

#include <unistd.h>

#include "apps/show.hpp"
#include "common/printable.hpp"

namespace swiftlet::apps {
namespace {

constexpr double kElsewhere_s = 2.0;

}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), interactive_(isatty(STDOUT_FILENO) != 0) {}

void ProgressLine::update(const std::string& text, double wall_s) {
  if (quiet_) return;
  if (interactive_) {
    showStyled("\r\033[K" + common::printable(text));
    open_ = true;
  } else if (wall_s - last_s_ >= kElsewhere_s) {
    last_s_ = wall_s;
    show(text + "\n");
  }
}

void ProgressLine::close() {
  if (open_) showStyled("\r\033[K");
  open_ = false;
}

}  // namespace swiftlet::apps
