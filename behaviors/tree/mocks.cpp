#include "behaviors/tree/mocks.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/elements.hpp"
#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/nodes/sequence.hpp"

namespace swiftlet::tree {
namespace {

/// A value of the type of a port, where no other is known.
Value standInValue(const PortManifest& port) {
  switch (port.type) {
    case PortType::kDouble:
      return 0.0;
    case PortType::kInt:
      return std::int64_t{0};
    case PortType::kBool:
      return false;
    case PortType::kPoint:
      return Point{};
    case PortType::kPoints:
      return Points{{Point{}}};
    case PortType::kRectangle:
      return Rectangle{0.0, 0.0, 1.0, 1.0};
    case PortType::kDuration:
      return Duration{};
    case PortType::kAny:
    case PortType::kString:
    case PortType::kScript:
      break;
  }
  return port.name;
}

class MockLeaf final : public Leaf {
 public:
  MockLeaf(const NodeSetup& setup, const MockAnswer& answer) : Leaf(setup), answer_(answer) {
    for (const PortBinding& binding : setup.ports) {
      if (binding.slot == nullptr) continue;
      if (binding.manifest->direction == Direction::kInput) inputs_.push_back(binding);
      if (binding.manifest->direction == Direction::kOutput) outputs_.push_back(binding);
    }
  }

 private:
  Status answer(bool ticked) const { return answer_ ? answer_(*this, ticked) : Status::kSuccess; }
  bool onAsked(const TickContext&) const override { return answer(false) != Status::kSkipped; }
  void onStart(TickContext&) override {
    problem_.clear();
    for (const PortBinding& input : inputs_)
      if (problem_.empty()) problem_ = readingProblem(input);
  }
  Status act(TickContext& context) override {
    if (!problem_.empty()) return fail(context, problem_);
    const Status status = answer(true);
    if (status == Status::kSuccess)
      for (const PortBinding& output : outputs_) output.slot->write(standInValue(*output.manifest));
    return status == Status::kSkipped ? Status::kRunning : status;
  }

  MockAnswer answer_;
  std::vector<PortBinding> inputs_, outputs_;  ///< Those that are bound to entries.
  std::string problem_;                        ///< Of an input that could not be read at the start.
};

/// What the files say about a type.
struct MockFacts {
  std::optional<NodeKind> declared;
  std::size_t most_children = 0;
  bool used = false;
  std::vector<std::string> ports;
  std::string missing_port;  ///< Of the type of the same name in the registry.

  NodeKind kind() const {
    if (declared) return *declared;
    return most_children > 1 ? NodeKind::kControl : most_children == 1 ? NodeKind::kDecorator : NodeKind::kAction;
  }
  void addPort(const std::string& name) {
    constexpr std::size_t kMost = 200;  // Bounded for speed, because each node searches it.
    if (ports.size() < kMost && std::find(ports.begin(), ports.end(), name) == ports.end()) ports.push_back(name);
  }
};

class MockFinder {
 public:
  explicit MockFinder(const Registry& base) : base_(base), engine_(Registry::standard()) {}

  void readModels(const XmlElement& models) {
    for (const XmlElement& model : models.children) {
      const std::string* id = model.attribute("ID");
      const auto kind = explicitKind(model.name);
      if (id == nullptr || !kind) continue;
      MockFacts& facts = facts_[*id];
      facts.declared = kind;
      for (const XmlElement& port : model.children)
        if (const std::string* name = port.attribute("name")) facts.addPort(*name);
    }
  }

  /// Depth is bounded by that of the XML.
  void readUses(const XmlElement& element) {
    if (!isSubTree(element)) readUse(element);
    for (const XmlElement& child : element.children) readUses(child);
  }

  const std::map<std::string, MockFacts>& facts() const { return facts_; }

  bool isMocked(const std::string& id, const MockFacts& facts) const {
    return facts.used && (base_.find(id) == nullptr || !facts.missing_port.empty());
  }
  /// A type of the registry that is not of the engine.
  bool usesBase() const {
    return std::any_of(facts_.begin(), facts_.end(),
                       [&](const auto& fact) { return fact.second.used && base_.find(fact.first) != nullptr; });
  }

 private:
  void readUse(const XmlElement& element) {
    const auto kind = explicitKind(element.name);
    const std::string* id = kind ? element.attribute("ID") : &element.name;
    if (id == nullptr || id->empty() || engine_.find(*id) != nullptr) return;
    MockFacts& facts = facts_[*id];
    facts.used = true;
    facts.most_children = std::max(facts.most_children, element.children.size());
    if (kind && !facts.declared) facts.declared = kind;
    const NodeType* type = base_.find(*id);
    for (const XmlAttribute& attribute : element.attributes) {
      if (isStructural(element, attribute.name) || conditionOf(attribute.name) || attribute.name.starts_with('_'))
        continue;
      facts.addPort(attribute.name);
      if (type != nullptr && type->manifest.findPort(attribute.name) == nullptr) facts.missing_port = attribute.name;
    }
  }

  const Registry& base_;
  Registry engine_;
  std::map<std::string, MockFacts> facts_;
};

NodeManifest mockManifest(const std::string& id, const MockFacts& facts) {
  NodeManifest manifest{.id = id, .kind = facts.kind(), .ports = {}, .description = "A mock.", .may_skip = true};
  for (const std::string& port : facts.ports)
    manifest.ports.push_back({.name = port, .type = PortType::kString, .direction = Direction::kInOut});
  return manifest;
}

}  // namespace

void addMockLeaf(Registry& registry, const NodeManifest& manifest, const MockAnswer& answer) {
  registry.add(manifest, [answer](const NodeSetup& setup) { return std::make_unique<MockLeaf>(setup, answer); });
}

MockedRegistry withMocks(const std::string& path, const Registry& base, const ParseOptions& options,
                         const MockAnswer& answer) {
  MockedRegistry mocked{base, {}, options};
  mocked.options.lenient = true;
  Problems ignored(options.limits.problems);
  Documents documents(mocked.options, ignored);
  documents.load(path);
  MockFinder finder(base);
  for (const auto& document : documents.documents)
    for (const XmlElement& element : document->root.children)
      if (element.name == "TreeNodesModel") finder.readModels(element);
  for (const auto& document : documents.documents)
    for (const XmlElement& element : document->root.children)
      if (element.name == "BehaviorTree")
        for (const XmlElement& child : element.children) finder.readUses(child);

  for (const auto& [id, facts] : finder.facts()) {
    // The name of a tree is a mistake for a SubTree: the checker reports it.
    if (!finder.isMocked(id, facts) || documents.trees.contains(id)) continue;
    const NodeManifest manifest = mockManifest(id, facts);
    mocked.mocks.push_back({id, manifest.kind, facts.missing_port});
    if (manifest.minChildren() > 0)
      mocked.registry.add(manifest, [](const NodeSetup& setup) { return std::make_unique<Sequence>(setup); });
    else
      addMockLeaf(mocked.registry, manifest, answer);
  }
  mocked.options.host_sets_entries = !mocked.mocks.empty() || !finder.usesBase();
  return mocked;
}

}  // namespace swiftlet::tree
