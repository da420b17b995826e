// The commands of the program, one file each.
#pragma once

#include "apps/command_line.hpp"

namespace swiftlet::apps {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,  ///< A flight did not pass, a log was never localized or not read to its end, something is missing, or a
                ///< graph did not converge.
  kBadInput = 2,  ///< Wrong usage or input that cannot be used, a mission that is not sound too.
};

/// Each adds its command to `program`.
void addFly(Command& program);
void addCheck(Command& program);
void addTrial(Command& program);
void addMap(Command& program);
void addLocalize(Command& program);
void addConfig(Command& program);
void addDoctor(Command& program);
void addVersion(Command& program);
void addEvaluate(Command& program);
void addOptimize(Command& program);

}  // namespace swiftlet::apps
