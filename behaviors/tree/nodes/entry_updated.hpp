// Nodes that ask whether an entry was written since they last saw it, also with the same value. The first time, an
// entry that is set counts as written. What was seen outlasts the end of the node.
//   WasEntryUpdated    a leaf: SUCCESS if it was, else FAILURE
//   SkipUnlessUpdated  a decorator: runs the child if it was, else SKIPPED
//   WaitValueUpdate    a decorator: runs the child if it was, else RUNNING
// A child that is under way goes on, whatever is written.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

/// Remembers how often an entry had been written when it was last seen.
class EntryNews {
 public:
  explicit EntryNews(const NodeSetup& setup) : entry_(setup.port("entry").slot) {}
  static PortManifest port();

  bool any() const { return entry_->writes != seen_ && entry_->value.has_value(); }
  void see() { seen_ = entry_->writes; }

 private:
  const Slot* entry_;
  std::uint64_t seen_ = 0;
};

class WasEntryUpdated final : public Leaf {
 public:
  explicit WasEntryUpdated(const NodeSetup& setup) : Leaf(setup), news_(setup) {}
  static NodeManifest manifest();

 private:
  Status act(TickContext&) override;

  EntryNews news_;
};

class UnlessUpdated : public Composite {
 protected:
  UnlessUpdated(const NodeSetup& setup, Status without) : Composite(setup), news_(setup), without_(without) {}

 private:
  Status run(TickContext& context) final;
  bool onAsked(const TickContext& context) const final;

  EntryNews news_;
  Status without_;  ///< The answer if the entry was not updated.
};

class SkipUnlessUpdated final : public UnlessUpdated {
 public:
  explicit SkipUnlessUpdated(const NodeSetup& setup) : UnlessUpdated(setup, Status::kSkipped) {}
  static NodeManifest manifest();
};

class WaitValueUpdate final : public UnlessUpdated {
 public:
  explicit WaitValueUpdate(const NodeSetup& setup) : UnlessUpdated(setup, Status::kRunning) {}
  static NodeManifest manifest();
};

}  // namespace swiftlet::tree
