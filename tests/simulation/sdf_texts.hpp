// Texts of small worlds.
#pragma once

#include <string>

namespace swiftlet::simulation {

inline const std::string kBox = "<box><size>1 2 3</size></box>";

inline std::string model(const std::string& name, const std::string& geometry,
                         const std::string& pose = "0 0 0 0 0 0") {
  return "<model name='" + name + "'><static>1</static><pose>" + pose +
         "</pose><link name='l'><collision name='c'><geometry>" + geometry + "</geometry></collision></link></model>\n";
}

}  // namespace swiftlet::simulation
