// The part of the naive interpreter that knows entries: scripts, queues, what was written, and trees in trees.
#include <algorithm>
#include <array>

#include "tests/tree/oracle.hpp"

namespace swiftlet::tree::testing::oracle {
namespace {

constexpr std::array<Status, 4> kAnswers = {Status::kSuccess, Status::kFailure, Status::kRunning, Status::kSkipped};
constexpr std::array<const char*, 4> kWatched = {"n", "m", "i", "s"};

const char* watchedBy(const Shape& shape) { return kWatched[static_cast<std::size_t>(shape.leaf) % kWatched.size()]; }

/// The entry that gets the elements of a queue.
std::string elementEntry(const Shape& shape) {
  if (shape.type == "LoopDouble") return "m";
  if (shape.type == "LoopInt") return "i";
  return shape.type == "LoopBool" ? "b" : "s";
}

double element(int index) { return (2 * index) % 5; }

std::string queueOf(const Shape& shape) {
  std::string queue;
  for (int i = 0; i < shape.number; ++i) {
    const int number = static_cast<int>(element(i));
    const std::string text = shape.type == "LoopBool"     ? number > 2 ? "true" : "false"
                             : shape.type == "LoopDouble" ? std::to_string(number) + ".0"
                                                          : std::to_string(number);
    queue += (i == 0 ? "" : ";") + text;
  }
  return queue;
}

int casesOf(const Shape& shape) { return shape.type.back() - '0'; }

std::string timesOf(const std::string& attribute, int ticks) {
  return " " + attribute + "=\"" + std::to_string(100 * ticks) + "\"";
}

std::string numberOf(const std::string& attribute, int number) {
  return " " + attribute + "=\"" + std::to_string(number) + "\"";
}

std::string switchAttributes(const Shape& shape) {
  const std::string variable = shape.number2 % 2 != 0 ? "{n}" : std::to_string(shape.number);
  std::string text = " variable=\"" + variable + "\"";
  for (int i = 0; i < casesOf(shape); ++i) text += numberOf("case_" + std::to_string(i + 1), i);
  return text;
}

std::string sharingOf(const Shape& shape) {
  constexpr std::array<const char*, 5> kSharings = {"", " n=\"{n}\" m=\"{m}\"", " n=\"{m}\" m=\"{n}\"", " n=\"{n}\"",
                                                    " _autoremap=\"true\""};
  return kSharings[static_cast<std::size_t>(shape.number)];
}

/// The attributes that only some types have.
std::string attributesOf(const Shape& shape) {
  const std::string& type = shape.type;
  const std::string status = toString(kAnswers[static_cast<std::size_t>(shape.number2) % 4]);
  if (type == "Precondition")
    return std::string(" if=\"") + (shape.number > 0 ? "n >= 0" : "n &lt; 0") + "\" else=\"" + status + "\"";
  if (type.starts_with("Loop"))
    return " queue=\"" + queueOf(shape) + "\" if_empty=\"" + status + "\" value=\"{" + elementEntry(shape) + "}\"";
  if (type.starts_with("Switch")) return switchAttributes(shape);
  if (type.find("Update") != std::string::npos) return std::string(" entry=\"{") + watchedBy(shape) + "}\"";
  if (type == "Delay") return timesOf("delay_msec", shape.number);
  if (type == "Timeout" || type == "Sleep") return timesOf("msec", shape.number);
  if (type == "Repeat") return numberOf("num_cycles", shape.number);
  if (type == "RetryUntilSuccessful") return numberOf("num_attempts", shape.number);
  if (type == "Parallel") return numberOf("success_count", shape.number) + numberOf("failure_count", shape.number2);
  if (type == "ParallelAll") return numberOf("max_failures", shape.number);
  if (type == "RunOnce") return shape.number > 0 ? " then_skip=\"true\"" : " then_skip=\"false\"";
  return {};
}

std::string conditionsOf(const Shape& shape) {
  static const std::array<std::string, 4> kNames = {"", "_failureIf", "_successIf", "_skipIf"};
  std::string text = shape.counts ? " _onSuccess=\"" + shape.counter + " += 1\"" : "";
  if (shape.condition != Condition::kNone)
    text += " " + kNames[static_cast<std::size_t>(shape.condition)] + "=\"" + shape.counter + " >= 2\"";
  return text;
}

}  // namespace

std::string toXml(const Shape& shape, std::string& trees) {
  const std::string name = shape.type == "Leaf" ? std::string(1, static_cast<char>('A' + shape.leaf)) : shape.type;
  const std::string others = "; i := 0; s := 'none'";
  if (name == "Zero") return "<Script code=\"n := 0; m := 0" + others + "\"/>";
  if (name == "ZeroM") return "<Script code=\"m := n * 0" + others + "\"/>";
  if (name == "Touch") return "<Script code=\"n := n + 0; m := m + 0" + others + "\"/>";
  std::string inside;
  for (const Shape& child : shape.children) inside += toXml(child, trees);
  if (name == "SubTree") {
    const std::string id = "T" + std::to_string(trees.size());  // No other tree begins at that place.
    trees += "<BehaviorTree ID=\"" + id + "\">" + inside + "</BehaviorTree>\n";
    return "<SubTree ID=\"" + id + "\"" + sharingOf(shape) + conditionsOf(shape) + "/>";
  }
  return "<" + name + attributesOf(shape) + conditionsOf(shape) + ">" + inside + "</" + name + ">";
}

/// The entry of that name in the tree that is being evaluated: its own, or that of the tree around it.
Oracle::Entry& Oracle::entry(const std::string& name) {
  std::string known = name;
  std::size_t depth = bug_ == Bug::kScopesShared ? 0 : scopes_.size();
  for (; depth > 0; --depth) {
    const Sharing sharing = scopes_[depth - 1].sharing;
    const bool counter = known == "n" || known == "m";
    const bool swaps = sharing == Sharing::kSwapped && bug_ != Bug::kSwapIgnored;
    if (sharing == Sharing::kNone || (sharing == Sharing::kOne && known != "n") ||
        (sharing != Sharing::kAutomatic && !counter))
      break;
    if (swaps) known = known == "n" ? "m" : "n";
  }
  return memory_.entries[(depth > 0 ? scopes_[depth - 1].path : "") + ":" + known];
}

void Oracle::write(const std::string& name, double value) {
  Entry& written = entry(name);
  written.value = value;
  ++written.writes;
}

Status Oracle::evalScript(const Shape& shape) {
  const bool touches = shape.type == "Touch";
  if (shape.type != "ZeroM") write("n", touches ? entry("n").value : 0.0);
  write("m", touches ? entry("m").value : 0.0);
  write("i", 0.0);
  write("s", 0.0);
  return Status::kSuccess;
}

Status Oracle::evalQueue(const Shape& shape, const std::string& path) {
  const std::string child = childPath(path, 0);
  int& taken = memory_.number[path];
  if (bug_ == Bug::kLoopStartsAnew) taken = 0;
  if (!memory_.under_way.contains(child)) {
    if (taken >= shape.number) return kAnswers[static_cast<std::size_t>(shape.number2) % 4];
    if (bug_ != Bug::kElementLost) write(elementEntry(shape), element(taken));
    ++taken;
  }
  return eval(shape.children[0], child) == Status::kFailure ? Status::kFailure : Status::kRunning;
}

/// Asked at every tick; a child that is no longer chosen is given up.
Status Oracle::evalSwitch(const Shape& shape, const std::string& path) {
  const double variable = shape.number2 % 2 != 0 ? entry("n").value : shape.number;
  const int cases = casesOf(shape);
  int chosen = variable >= 0.0 && variable < cases ? static_cast<int>(variable) : cases;
  if (bug_ == Bug::kSwitchSticks) chosen = memory_.number.try_emplace(path, chosen).first->second;
  for (int other = 0; other <= cases; ++other)
    if (other != chosen) forget(childPath(path, static_cast<std::size_t>(other)));
  return eval(shape.children[static_cast<std::size_t>(chosen)], childPath(path, static_cast<std::size_t>(chosen)));
}

/// What was seen outlasts the end of the node.
Status Oracle::evalUpdated(const Shape& shape, const std::string& path) {
  const bool leaf = shape.type == "WasEntryUpdated";
  const std::string child = childPath(path, 0);
  if (leaf || !memory_.under_way.contains(child)) {
    const int writes = entry(watchedBy(shape)).writes;
    int& seen = memory_.kept[path];
    const bool news = bug_ == Bug::kNewsForgotten ? writes > 0 : writes != seen;
    if (bug_ != Bug::kNewsNotTaken) seen = writes;
    if (leaf) return news ? Status::kSuccess : Status::kFailure;
    if (!news) return shape.type == "SkipUnlessUpdated" ? Status::kSkipped : Status::kRunning;
  }
  return eval(shape.children[0], child);
}

Status Oracle::evalSubTree(const Shape& shape, const std::string& path) {
  scopes_.push_back({path, static_cast<Sharing>(shape.number)});
  const Status status = eval(shape.children[0], childPath(path, 0));
  scopes_.pop_back();
  return status;
}

}  // namespace swiftlet::tree::testing::oracle
