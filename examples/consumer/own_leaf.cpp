// Two leaves of one's own, and a mission that uses them: the tree engine without anything else of Swiftlet.
#include <cstdint>
#include <cstdio>
#include <string>

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/parser.hpp"

namespace {

namespace tree = swiftlet::tree;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Walks for a while. The ports say what the XML may give, and in which unit.
class Walk : public tree::Leaf {
 public:
  static tree::NodeManifest manifest() {
    return {.id = "Walk",
            .ports = {{.name = "to", .type = tree::PortType::kString, .required = true, .description = "Where to."},
                      {.name = "duration_s",
                       .type = tree::PortType::kDouble,
                       .default_value = "1",
                       .minimum = 0,
                       .description = "How long it takes."}},
            .description = "Walks somewhere."};
  }
  explicit Walk(const tree::NodeSetup& setup) : Leaf(setup), to_(setup, "to"), duration_s_(setup, "duration_s") {}

 private:
  void onStart(tree::TickContext&) override { walked_s_ = 0.0; }
  tree::Release onSuspend(tree::TickContext&) override {
    std::printf("      stops on the way to the %s\n", to_.get()->c_str());
    return tree::Release::kReleased;
  }
  tree::Status act(tree::TickContext& context) override {
    walked_s_ += 1.0;
    std::printf("%2d s  walks to the %s\n", static_cast<int>(context.now_ns / kSecond_ns), to_.get()->c_str());
    return walked_s_ < *duration_s_.get() ? tree::Status::kRunning : tree::Status::kSuccess;
  }

  tree::Input<std::string> to_;
  tree::Input<double> duration_s_;
  double walked_s_ = 0.0;
};

/// Has something to do only while a person calls: from second 2 to 4.
class Answer : public tree::Leaf {
 public:
  static tree::NodeManifest manifest() {
    return {.id = "Answer", .description = "Answers a person who calls.", .may_skip = true};
  }
  using Leaf::Leaf;

 private:
  bool onAsked(const tree::TickContext& context) const override { return context.now_ns == 2 * kSecond_ns; }
  tree::Status act(tree::TickContext& context) override {
    std::printf("%2d s  answers\n", static_cast<int>(context.now_ns / kSecond_ns));
    return context.now_ns < 4 * kSecond_ns ? tree::Status::kRunning : tree::Status::kSuccess;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: own_leaf MISSION.xml\n");
    return 2;
  }
  tree::Registry registry = tree::Registry::standard();
  registry.add<Walk>();
  registry.add<Answer>();
  tree::ParseResult mission = tree::parseFile(argv[1], registry);
  if (!mission.tree) {
    std::fprintf(stderr, "%s\n", tree::toString(mission.problems).c_str());
    return 2;
  }
  tree::Status status = tree::Status::kRunning;
  for (std::int64_t now_ns = kSecond_ns; tree::isActive(status); now_ns += kSecond_ns) {
    tree::TickContext context(now_ns);
    status = mission.tree->tick(context);
  }
  std::printf("%s\n", tree::toString(status));
  return status == tree::Status::kSuccess ? 0 : 1;
}
