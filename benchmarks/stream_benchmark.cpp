// links: web fake_backend
// Twenty tablets that watch the map at 10 frames a second, one that reads nothing, and five pages: how old the frames
// are when they are whole at the client, and what the server's thread costs.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/console/fake_backend.hpp"

namespace swiftlet::testing {
namespace {

constexpr const char* kBoundary = "\r\n--swiftlet-frame\r\n";

int connectTo(int port, const std::string& target) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return -1;
  const std::string request = "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  if (send(socket, request.data(), request.size(), MSG_NOSIGNAL) < 0) return -1;
  return socket;
}

/// Notes the age of each frame when its last byte is there.
void watch(int port, const std::string& target, const std::atomic<bool>& stop, std::vector<double>& ages) {
  const int socket = connectTo(port, target);
  std::string buffer;
  std::array<char, 65536> bytes;
  while (!stop) {
    const auto count = recv(socket, bytes.data(), bytes.size(), 0);
    if (count <= 0) break;
    buffer.append(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t end; (end = buffer.find(kBoundary)) != std::string::npos; buffer.erase(0, end + 20))
      if (const std::size_t at = buffer.find("X-Timestamp: "); at < end)
        ages.push_back(unixTime().seconds() - std::stod(buffer.substr(at + 13, 24)));
  }
  close(socket);
}

void twentyTabletsAndOneThatReadsNothing(benchmark::State& state) {
  for (auto _ : state) {
    FakeBackend::Setup setup;
    setup.warm_up_s = 30.0;
    FakeBackend backend(setup);
    std::atomic<bool> stop = false;
    std::vector<std::vector<double>> ages(20);
    std::vector<std::jthread> clients;
    const int stuck = connectTo(backend.port(), "/stream/map.mjpg?width=1280&fps=30");
    // Four different views, so that sharing does not hide the encoding.
    const std::array<const char*, 4> targets{
        "/stream/map.mjpg?width=640&fps=10", "/stream/map.mjpg?width=640&fps=10&scheme=dark",
        "/stream/map.mjpg?width=480&fps=10", "/stream/camera.mjpg?width=480&fps=10"};
    for (std::size_t i = 0; i < ages.size(); ++i)
      clients.emplace_back([&, i] { watch(backend.port(), targets[i % 4], stop, ages[i]); });
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const double cpu_s = backend.serverCpu_s();
    std::this_thread::sleep_for(std::chrono::seconds(6));
    state.counters["server_cpu_percent"] = 100.0 * (backend.serverCpu_s() - cpu_s) / 6.0;
    stop = true;
    clients.clear();
    close(stuck);

    std::vector<double> all;
    std::size_t fewest = 1000;
    for (const auto& one : ages) {
      all.insert(all.end(), one.begin(), one.end());
      fewest = std::min(fewest, one.size());
    }
    std::sort(all.begin(), all.end());
    state.counters["frames_fewest"] = static_cast<double>(fewest);
    state.counters["age_ms_p50"] = 1000.0 * all[all.size() / 2];
    state.counters["age_ms_p99"] = 1000.0 * all[all.size() * 99 / 100];
    state.counters["age_ms_max"] = 1000.0 * all.back();
  }
}
BENCHMARK(twentyTabletsAndOneThatReadsNothing)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace swiftlet::testing
