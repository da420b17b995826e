// Values of a config as YAML text, for the printer and the reference page.
#pragma once

#include <string>
#include <vector>

namespace swiftlet::common::config {

std::string yamlOf(double value);
std::string yamlOf(bool value);
/// In double quotes.
std::string yamlOf(const std::string& value);
std::string yamlOf(const std::vector<double>& values);
std::string yamlOf(const std::vector<std::string>& values);

/// "a, b, c".
std::string listed(const std::vector<std::string>& words);

}  // namespace swiftlet::common::config
