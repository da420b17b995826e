#include "optimization/pose_graph_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::optimization {}  // namespace swiftlet::optimization
