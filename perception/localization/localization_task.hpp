// The search of the whole map as a value.
#pragma once

#include <memory>

namespace swiftlet::perception {

/// A search of the whole map; heavy. A pure function of what it was given and of the map, which never changes: for any
/// thread.
struct LocalizationTask {
  struct Data;
  std::shared_ptr<Data> data;
};

struct LocalizationResult {
  struct Data;
  std::shared_ptr<const Data> data;
};

LocalizationResult run(const LocalizationTask& task);

}  // namespace swiftlet::perception
