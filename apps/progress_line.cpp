#include "apps/progress_line.hpp"

#include <unistd.h>

#include <cmath>

#include <fmt/format.h>

#include "apps/show.hpp"
#include "common/printable.hpp"

namespace swiftlet::apps {
namespace {

constexpr double kElsewhere_s = 2.0;

std::string leftText(double left_s) {
  const auto minutes = std::lround(left_s / 60.0);
  if (left_s < 100.0) return fmt::format("about {:.0f} s left", 5.0 * std::ceil(left_s / 5.0));
  if (minutes < 60) return fmt::format("about {} min left", minutes);
  return fmt::format("about {} h {} min left", minutes / 60, minutes % 60);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), interactive_(isatty(STDOUT_FILENO) != 0) {}

void ProgressLine::update(const std::string& done, double wall_s, std::optional<double> left_s) {
  if (quiet_) return;
  const std::string text = left_s ? done + ", " + leftText(*left_s) : done;
  if (interactive_) {
    showStyled("\r\033[K" + common::printable(text));
    open_ = true;
  } else if (wall_s - last_s_ >= kElsewhere_s) {
    last_s_ = wall_s;
    show(text + "\n");
  }
}

void ProgressLine::update(double share, const std::string& done, double wall_s) {
  update(fmt::format("{:3.0f} %  {}", 100.0 * share, done), wall_s, time_left_.after(share, wall_s));
}

void ProgressLine::close() {
  if (open_) showStyled("\r\033[K");
  open_ = false;
}

}  // namespace swiftlet::apps
