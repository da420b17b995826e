// AlwaysSuccess and AlwaysFailure: leaves that end at once.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class AlwaysSuccess final : public Leaf {
 public:
  using Leaf::Leaf;
  static NodeManifest manifest() {
    return {.id = "AlwaysSuccess",
            .kind = NodeKind::kAction,
            .ports = {},
            .description = "SUCCESS at once.",
            .may_fail = false};
  }

 private:
  Status act(TickContext&) override { return Status::kSuccess; }
};

class AlwaysFailure final : public Leaf {
 public:
  using Leaf::Leaf;
  static NodeManifest manifest() {
    return {.id = "AlwaysFailure",
            .kind = NodeKind::kAction,
            .ports = {},
            .description = "FAILURE at once.",
            .may_succeed = false};
  }

 private:
  Status act(TickContext&) override { return Status::kFailure; }
};

}  // namespace swiftlet::tree
