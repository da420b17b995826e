// The search of the whole map as a task that can run in another thread.
#pragma once

#include <memory>

namespace swiftlet::perception {

/// A search of the whole map. Running it is expensive. It is a pure function of its data and of the map, which never
/// changes, so it may run in any thread.
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
