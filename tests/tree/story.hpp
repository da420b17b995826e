// Stories of trees, tick by tick. The leaves <A/> to <E/> are stand-ins whose answers the test sets; each tick returns
// the answer of the tree and what happened to the stand-ins in it, in order: "RUNNING: A, start B".
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/parser.hpp"
#include "behaviors/tree/registry.hpp"
#include "tests/tree/problem_matcher.hpp"

namespace swiftlet::tree::testing {

struct Actor {
  Status answer = Status::kRunning;
  bool wants = true;
  int ticks_to_stop = 0;  ///< How often it answers "not yet" when asked to let go.
  std::string throws_at;  ///< When it throws: "ticked", "asked", "letting go", "explaining", "a number ticked".
};

struct Stage {
  std::map<std::string, Actor, std::less<>> actors;
  std::vector<std::string> log;
};

/// The standard nodes (or those of `base`) and the stand-ins A, B, C, D, E.
Registry withStandIns(Stage& stage, const Registry& base = Registry::standard());

class Story {
 public:
  /// `inside` is the content of <BehaviorTree ID="Main">; `more` follows that element.
  explicit Story(std::string_view inside, std::string_view more = {});
  Story(std::string_view whole_file, const Registry& base);

  /// "SUCCESS", "FAILURE", "RUNNING", "nothing" (it is skipped), "stops in 2" (ticks), "throws ticked", or several with
  /// ", " between.
  Story& says(std::string_view actor, std::string_view what);
  /// Time passes (100 ms unless told), then one tick: "RUNNING: A, start B".
  std::string tick(int milliseconds = 100);
  /// One request to halt the whole tree: "let go: A halted".
  std::string halt();
  /// "Sequence RUNNING, A SUCCESS, B IDLE".
  std::string view() const;
  /// The switches since the last call: "A yields to B (reason)".
  std::vector<std::string> switches();
  /// Failures with their reasons since the last call: "Timeout: timed out after 1 s".
  std::vector<std::string> failures();

  Tree& tree() { return *tree_; }
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  class Witness final : public Observer {
   public:
    void onStatus(const Node&, Status, Status) override {}
    void onSwitch(const Switch& change) override;
    void onFailure(const Node& node, std::string_view reason) override;
    std::vector<std::string> switches;
    std::vector<std::string> failures;
  };

  void read(std::string text, const Registry& base);
  std::string happened();

  Stage stage_;
  Registry registry_;
  std::vector<Problem> problems_;
  std::optional<Tree> tree_;
  Witness witness_;
  std::int64_t now_ns_ = 0;
};

/// The problems of a tree with that content, whose leaves may be stand-ins.
std::vector<Problem> problemsInside(std::string_view inside);
/// The problems of a text named f.xml whose leaves are stand-ins.
std::vector<Problem> problemsWithStandIns(const std::string& text);
std::string file(std::string_view inside, std::string_view more = {});

}  // namespace swiftlet::tree::testing
