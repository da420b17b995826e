#include "apps/show.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>

namespace swiftlet::apps {

void outliveReaders() { std::signal(SIGPIPE, SIG_IGN); }

void show(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  if (std::fflush(stdout) != 0 && errno == EPIPE) std::clearerr(stdout);
}

}  // namespace swiftlet::apps
