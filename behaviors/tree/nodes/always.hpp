// AlwaysSuccess and AlwaysFailure: leaves that end at once.
#pragma once

#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class AlwaysSuccess final : public Leaf {
 public:
  using Leaf::Leaf;
  static NodeManifest manifest() {
    return {.id = "AlwaysSuccess", .kind = NodeKind::kAction, .ports = {}, .description = "SUCCESS at once."};
  }

 private:
  Status act(TickContext&) override { return Status::kSuccess; }
};

class AlwaysFailure final : public Leaf {
 public:
  using Leaf::Leaf;
  static NodeManifest manifest() {
    return {.id = "AlwaysFailure", .kind = NodeKind::kAction, .ports = {}, .description = "FAILURE at once."};
  }

 private:
  Status act(TickContext&) override { return Status::kFailure; }
};

}  // namespace swiftlet::tree
