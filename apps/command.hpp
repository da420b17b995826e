// A subcommand of the program. It declares its options, and is run if it was chosen.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace swiftlet::apps {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,  ///< A flight did not pass, a log was never localized or not read to its end, something is missing, or a
                ///< graph did not converge.
  kBadInput = 2,  ///< Wrong usage or input that cannot be used, a mission that is not sound too.
};

/// Each function adds its subcommand. If it is chosen, `run` is set to a function that executes it and returns the exit
/// code.
using Run = std::function<int()>;
void addFly(CLI::App& program, Run& run);
void addCheck(CLI::App& program, Run& run);
void addTrial(CLI::App& program, Run& run);
void addMap(CLI::App& program, Run& run);
void addLocalize(CLI::App& program, Run& run);
void addConfig(CLI::App& program, Run& run);
void addDoctor(CLI::App& program, Run& run);
void addVersion(CLI::App& program, Run& run);
void addEvaluate(CLI::App& program, Run& run);
void addOptimize(CLI::App& program, Run& run);

}  // namespace swiftlet::apps
