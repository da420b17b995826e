// The commands of the program, one file each.
#pragma once

#include "apps/command_line.hpp"

namespace swiftlet::apps {

/// Each adds its command to `program`.
void addFly(Command& program);
void addCheck(Command& program);
void addNodes(Command& program);
void addFailsafe(Command& program);
void addTrial(Command& program);
void addMap(Command& program);
void addMap3d(Command& program);
void addLocalize(Command& program);
void addConfig(Command& program);
void addDoctor(Command& program);
void addVersion(Command& program);
void addEvaluate(Command& program);
void addOptimize(Command& program);
void addConvert(Command& program);
void addMigrate(Command& program);
void addIdentify(Command& program);
void addPapers(Command& program);
void addTune(Command& program);
void addConsistency(Command& program);
void addWorld(Command& program);
void addPlan(Command& program);
void addExploreBench(Command& program);

}  // namespace swiftlet::apps
