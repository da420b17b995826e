// swiftlet migrate: rewrites missions of BehaviorTree.CPP 3 for version 4.
#include <memory>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/output_file.hpp"
#include "apps/show.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/tree/migrate.hpp"
#include "common/error.hpp"
#include "common/printable.hpp"
#include "common/read_bytes.hpp"
#include "flight/files_of_kind.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"

namespace swiftlet::apps {
namespace {

struct MigrateOptions {
  std::string file;
  std::string out;
};

int migrate(const MigrateOptions& options) {
  if (!options.out.empty()) requireWritable(options.out, "--out");
  const std::string file = flight::findMission(options.file);
  const tree::Migration migration = tree::migrateToVersion4(common::readText(file), file);
  if (!migration.problems.empty()) throw common::InputError(behaviors::toCommon(migration.problems));
  // What is printed to the standard output is the file alone, so that it can be redirected.
  for (const tree::Problem& change : migration.changes) showError(common::printable(toString(change)) + "\n");
  if (migration.changes.empty()) showError(fmt::format("{}: it is of version 4 already\n", file));
  if (options.out.empty()) {
    show(migration.text);
  } else {
    required(interfaces::writeAtomically(options.out, migration.text));
    show(fmt::format("written {}\n", options.out));
  }
  return kDone;
}

}  // namespace

void addMigrate(Command& program) {
  auto options = std::make_shared<MigrateOptions>();
  Command command = program.command(
      "migrate", "Rewrite a mission of BehaviorTree.CPP 3 for version 4; comments and layout stay as they are.");
  command.argument("file", options->file,
                   "A mission file of version 3. Files that it includes are migrated one by one.");
  command.option("--out", options->out, "Where to write it, also over the file itself. Printed when not given.");
  command.footer("Example: swiftlet migrate old.xml --out new.xml");
  command.runs([options] { return migrate(*options); });
}

}  // namespace swiftlet::apps
