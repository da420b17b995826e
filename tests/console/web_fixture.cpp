// Serves the operator's page with a made-up flight until its standard input ends: web_fixture [PORT [TOKEN
// [plain|silent|map3d|tree|given [PUBLIC_URL ...]]]]. `silent`: its commands are never answered. `map3d`: it makes a 3D
// map. `tree`: its mission has 500 nodes, some of which change in each world. `given`: it knows its place in a given
// map.
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "tests/console/fake_backend.hpp"

int main(int count, char** arguments) {
  swiftlet::testing::FakeBackend::Setup setup;
  if (count > 1) setup.port = std::atoi(arguments[1]);
  if (count > 2) setup.token = arguments[2];
  setup.answers = count < 4 || std::string_view(arguments[3]) != "silent";
  if (count > 3 && std::string_view(arguments[3]) == "tree") setup.tree_nodes = 500;
  setup.maps3d = count > 3 && std::string_view(arguments[3]) == "map3d";
  setup.given = count > 3 && std::string_view(arguments[3]) == "given";
  for (int i = 4; i < count; ++i) setup.public_urls.emplace_back(arguments[i]);
  swiftlet::testing::FakeBackend backend(setup);
  for (const std::string& url : backend.server().operatorUrls()) std::cout << url << std::endl;
  std::string line;
  while (std::getline(std::cin, line)) {}
}
