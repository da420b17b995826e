// A naive interpreter of trees that shares no file with the engine: no node objects, only a map from the path of a node
// to its state. Letting go takes no time here, a tick takes 100 ms, and "would it be skipped?" is answered by trying it
// on a copy of the whole state.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace swiftlet::tree::testing::oracle {

enum class Status { kRunning, kSuccess, kFailure, kSkipped };
std::string toString(Status status);

/// Scripted conditions, over the counters `n` and `m`.
enum class Condition { kNone, kFailureIf, kSuccessIf, kSkipIf };

/// How a SubTree shares the counters.
enum class Sharing { kNone, kSame, kSwapped, kOne, kAutomatic };

struct Shape {
  /// A node type, or "Leaf". "Zero" is a Script that sets both counters to 0, "ZeroM" only `m`, and "Touch" writes them
  /// as they are; all three set the entries of queues, too.
  std::string type;
  /// num_cycles, num_attempts, success_count, max_failures, then_skip, ticks of a time, elements of a queue, the case
  /// of a Switch, the truth of a Precondition, the Sharing of a SubTree.
  int number = 0;
  int number2 = 0;                         ///< failure_count, the status `else` or `if_empty`; odd: Switch over `n`.
  int leaf = 0;                            ///< Which stand-in, or which entry is watched.
  Condition condition = Condition::kNone;  ///< `n >= 2` decides before it starts.
  bool counts = false;                     ///< `_onSuccess="n += 1"`.
  std::string counter = "n";               ///< The one that both are about.
  std::vector<Shape> children = {};
};

/// The answer of every stand-in in one tick. kSkipped: it does not want the vehicle (if it is under way, it keeps
/// running).
using Answers = std::vector<Status>;

/// Deliberately wrong variants, to see that the comparison notices.
enum class Bug {
  kNone,
  kSequenceRestarts,
  kPriorityResets,
  kReactiveRemembers,
  kMemoryForgets,
  kLoopStartsAnew,
  kClockRunsTwice,
  kConditionsIgnored,
  kNewsForgotten,
  kNewsNotTaken,
  kSwitchSticks,
  kScopesShared,
  kSwapIgnored,
  kElementLost
};

class Oracle {
 public:
  explicit Oracle(Bug bug = Bug::kNone) : bug_(bug) {}
  /// The answer of the root and, in `log`, the stand-ins ticked, in order: "start A", "A", "resume A".
  Status tick(const Shape& shape, const Answers& answers, std::vector<std::string>& log);

 private:
  struct Entry {
    double value = 0.0;
    int writes = 0;
  };
  struct Memory {
    std::set<std::string> under_way;
    std::map<std::string, int> suspended;  ///< Nodes that let go, with the tick in which they did.
    std::map<std::string, int> number;     ///< Position of a Sequence, count of a Repeat.
    std::map<std::string, Status> ended;   ///< Children of a Parallel.
    std::map<std::string, int> kept;       ///< What outlasts the end of a node, by its path.
    std::map<std::string, Entry> entries;  ///< By the path of the tree that has them, and the name.
  };
  /// A SubTree that is being evaluated.
  struct Scope {
    std::string path;
    Sharing sharing = Sharing::kNone;
  };

  Status eval(const Shape& shape, const std::string& path);
  Status evalRule(const Shape& shape, const std::string& path);
  Status evalTimed(const Shape& shape, const std::string& path);
  Status evalQueue(const Shape& shape, const std::string& path);
  Status evalSwitch(const Shape& shape, const std::string& path);
  Status evalUpdated(const Shape& shape, const std::string& path);
  Status evalSubTree(const Shape& shape, const std::string& path);
  Status evalScript(const Shape& shape);
  Entry& entry(const std::string& name);
  void write(const std::string& name, double value);
  Status evalLeaf(const Shape& shape, const std::string& path);
  Status evalChain(const Shape& shape, const std::string& path, Status goes_on);
  Status evalReactive(const Shape& shape, const std::string& path, Status goes_on);
  Status evalParallel(const Shape& shape, const std::string& path);
  Status evalParallelAll(const Shape& shape, const std::string& path);
  Status evalChoice(const Shape& shape, const std::string& path, bool at_every_tick);
  Status evalWithMemory(const Shape& shape, const std::string& path);
  Status evalTryCatch(const Shape& shape, const std::string& path);
  Status evalOnce(const Shape& shape, const std::string& path);
  Status evalLoop(const Shape& shape, const std::string& path, Status counted);
  Status evalPriority(const Shape& shape, const std::string& path);
  bool wants(const Shape& shape, const std::string& path);
  void forget(const std::string& path);
  void suspendBelow(const std::string& path);

  Bug bug_;
  int now_ = 0;  ///< Ticks.
  Memory memory_;
  std::vector<Scope> scopes_;  ///< From the outermost in.
  const Answers* answers_ = nullptr;
  std::vector<std::string>* log_ = nullptr;
};

std::string childPath(const std::string& path, std::size_t index);
/// The shape as XML, with stand-ins A, B, ...; `trees` gets the trees that its SubTrees name.
std::string toXml(const Shape& shape, std::string& trees);

}  // namespace swiftlet::tree::testing::oracle
