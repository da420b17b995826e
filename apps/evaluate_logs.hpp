// swiftlet evaluate logs: the maps of all recorded logs, judged.
#pragma once

#include "apps/command_line.hpp"

namespace swiftlet::apps {

void addEvaluateLogs(Command& evaluate);

}  // namespace swiftlet::apps
