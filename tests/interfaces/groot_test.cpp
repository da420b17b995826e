// Groot2's monitor protocol: its bytes, and a client that speaks it over a socket.
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "interfaces/links/groot/groot_server.hpp"
#include "interfaces/links/groot/groot_xml.hpp"
#include "tests/support/problem_matchers.hpp"

#ifdef SWIFTLET_WITH_ZMQ
#include <zmq.h>
#endif

namespace swiftlet::interfaces {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

common::Time at(double seconds) { return common::Time::fromSeconds(seconds); }

std::string requestOf(char type, const std::string& id = "\x01\x02\x03\x04") { return std::string("\x02") + type + id; }

/// Priority [Hold, SubTree Visit [Sequence [MoveToGoal goal={place}, Land]]].
common::TreeView visitTree() {
  return {{0, -1, "Priority", "RUNNING", "Priority"},
          {1, 0, "Hold", "SKIPPED", "Hold"},
          {2, 0, "Visit", "RUNNING", "SubTree"},
          {3, 2, "Sequence", "RUNNING", "Sequence"},
          {4, 3, "to <door>", "RUNNING", "MoveToGoal", {{"goal", "place", "3;-1.5"}, {"mode", "", "fast"}}},
          {5, 3, "Land", "IDLE", "Land"}};
}

std::vector<int> statusesOf(const std::string& bytes) {
  std::vector<int> statuses;
  for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3) {
    EXPECT_EQ(static_cast<unsigned char>(bytes[i]) + 256 * static_cast<unsigned char>(bytes[i + 1]),
              static_cast<int>(i / 3) + 1);
    statuses.push_back(static_cast<unsigned char>(bytes[i + 2]));
  }
  return statuses;
}

class GrootMonitorStory : public ::testing::Test {
 protected:
  void show(double seconds) { monitor_.update(name_, tree_, at(seconds)); }
  std::string answer(char type, const std::string& second = {}) {
    std::vector<std::string> request = {requestOf(type)};
    if (!second.empty()) request.push_back(second);
    const std::vector<std::string> reply = monitor_.answer(request);
    EXPECT_EQ(reply[0].substr(0, 6), requestOf(type)) << reply.back();
    EXPECT_EQ(reply[0].size(), 22U);
    return reply.size() > 1 ? reply[1] : std::string();
  }
  std::string identity() { return monitor_.answer({requestOf('S')})[0].substr(6); }

  std::string name_ = "GoAndSee";
  common::TreeView tree_ = visitTree();
  GrootMonitor monitor_{"<TreeNodesModel/>\n"};
};

TEST_F(GrootMonitorStory, SendsTheTreeWithItsSubtrees) {
  show(0.0);
  EXPECT_EQ(answer('T'),
            "<root BTCPP_format=\"4\" main_tree_to_execute=\"GoAndSee\">\n"
            "<BehaviorTree ID=\"GoAndSee\" _fullpath=\"\">\n"
            "<Priority name=\"Priority\" _uid=\"1\">\n"
            "<Hold name=\"Hold\" _uid=\"2\"/>\n"
            "<SubTree ID=\"Visit\" _fullpath=\"Visit::3\" _uid=\"3\"/>\n"
            "</Priority>\n</BehaviorTree>\n"
            "<BehaviorTree ID=\"Visit\" _fullpath=\"Visit::3\">\n"
            "<Sequence name=\"Sequence\" _uid=\"4\">\n"
            "<MoveToGoal name=\"to &lt;door&gt;\" _uid=\"5\" goal=\"{place}\" mode=\"fast\"/>\n"
            "<Land name=\"Land\" _uid=\"6\"/>\n"
            "</Sequence>\n</BehaviorTree>\n"
            "<TreeNodesModel/>\n</root>\n");
}

TEST_F(GrootMonitorStory, TellsTheTreeOfASubTreeFromItsNameAndFromTheMainTree) {
  name_.clear();
  tree_[2].name = "first visit";
  tree_[2].ports = {{"ID", {}, "Main"}, {"_skipIf", {}, "n < 2"}};
  show(0.0);
  const std::string xml = answer('T');
  EXPECT_THAT(xml, HasSubstr("<root BTCPP_format=\"4\" main_tree_to_execute=\"Main_\">"));
  EXPECT_THAT(xml, HasSubstr("<SubTree ID=\"Main\" _fullpath=\"first visit::3\" name=\"first visit\" _uid=\"3\" "
                             "_skipIf=\"n &lt; 2\"/>"));
  EXPECT_THAT(xml, HasSubstr("<BehaviorTree ID=\"Main\" _fullpath=\"first visit::3\">"));
}

TEST_F(GrootMonitorStory, SendsStatusesAndWhatIdleNodesWereBefore) {
  show(0.0);
  EXPECT_THAT(statusesOf(answer('S')), ElementsAre(1, 4, 1, 1, 1, 0));
  tree_[4].status = "SUCCESS";
  tree_[5].status = "RUNNING";
  show(0.1);
  EXPECT_THAT(statusesOf(answer('S')), ElementsAre(1, 4, 1, 1, 2, 1));
  tree_[4].status = "IDLE";
  tree_[5].status = "SUSPENDED";
  show(0.2);
  EXPECT_THAT(statusesOf(answer('S')), ElementsAre(1, 4, 1, 1, 12, 11));
  tree_[4].status = "FAILURE";
  tree_[5].status = "RUNNING";
  show(0.3);
  EXPECT_THAT(statusesOf(answer('S')), ElementsAre(1, 4, 1, 1, 3, 1));
}

TEST_F(GrootMonitorStory, SendsTheBlackboardsThatAreAskedFor) {
  show(0.0);
  const auto all = nlohmann::json::from_msgpack(answer('B', "GoAndSee;Visit::3;Nowhere"));
  EXPECT_EQ(all, nlohmann::json({{"GoAndSee", nlohmann::json::object()}, {"Visit::3", {{"place", "3;-1.5"}}}}));
  EXPECT_EQ(nlohmann::json::from_msgpack(answer('B')), nlohmann::json::object());
}

TEST_F(GrootMonitorStory, RecordsEveryChangeBetweenStartAndStop) {
  show(2.0);
  EXPECT_EQ(answer('r', "start"), "2000000");
  tree_[4].status = "SUCCESS";
  tree_[5].status = "RUNNING";
  show(2.5);
  const std::string bytes = answer('t');
  ASSERT_EQ(bytes.size(), 18U);
  EXPECT_EQ(bytes.substr(0, 9), std::string("\x20\xa1\x07\x00\x00\x00\x05\x00\x02", 9)) << "node 5 at 500000 us";
  EXPECT_EQ(bytes.substr(6 + 9), std::string("\x06\x00\x01", 3));
  EXPECT_EQ(answer('t'), "") << "each change is sent once";
  EXPECT_EQ(answer('r', "stop"), "");
  tree_[5].status = "SUCCESS";
  show(3.0);
  EXPECT_EQ(answer('t'), "");
}

TEST_F(GrootMonitorStory, AnotherMissionHasAnotherIdentity) {
  show(0.0);
  const std::string first = identity();
  tree_[4].status = "FAILURE";
  tree_[4].ports[0].value = "1;1";
  show(0.1);
  EXPECT_EQ(identity(), first);
  name_ = "GoAndLook";
  show(0.15);
  EXPECT_NE(identity(), first) << "the same nodes, but another mission";
  tree_.pop_back();
  show(0.2);
  EXPECT_NE(identity(), first);
  EXPECT_EQ(statusesOf(answer('S')).size(), 5U);
}

TEST_F(GrootMonitorStory, HasNoBreakpoints) {
  show(0.0);
  EXPECT_EQ(answer('D'), "[]");
  EXPECT_EQ(answer('A'), "");
  EXPECT_EQ(answer('X'), "");
  for (const char type : {'I', 'R', 'U'})
    EXPECT_THAT(monitor_.answer({requestOf(type), "{}"}), ElementsAre("error", "a flight has no breakpoints"));
}

TEST_F(GrootMonitorStory, RefusesWhatIsNoRequest) {
  show(0.0);
  const std::vector<std::vector<std::string>> all = {{},
                                                     {std::string()},
                                                     {std::string("hello")},
                                                     {std::string("1234567")},
                                                     {std::string("\x01T") + "abcd"},
                                                     {requestOf('?')},
                                                     {requestOf('r')},
                                                     {requestOf('r'), std::string("pause")}};
  for (const std::vector<std::string>& wrong : all) EXPECT_EQ(monitor_.answer(wrong).at(0), "error");
}

#ifdef SWIFTLET_WITH_ZMQ

/// What Groot2 does: a request socket that sends parts and waits for the reply.
class GrootClient {
 public:
  explicit GrootClient(int port) : context_(zmq_ctx_new()), socket_(zmq_socket(context_, ZMQ_REQ)) {
    const int patience_ms = 20'000, linger = 0;
    zmq_setsockopt(socket_, ZMQ_RCVTIMEO, &patience_ms, sizeof patience_ms);
    zmq_setsockopt(socket_, ZMQ_LINGER, &linger, sizeof linger);
    zmq_connect(socket_, ("tcp://127.0.0.1:" + std::to_string(port)).c_str());
  }
  ~GrootClient() {
    zmq_close(socket_);
    zmq_ctx_term(context_);
  }
  GrootClient(const GrootClient&) = delete;
  GrootClient& operator=(const GrootClient&) = delete;

  std::vector<std::string> ask(const std::vector<std::string>& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      zmq_send(socket_, parts[i].data(), parts[i].size(), i + 1 < parts.size() ? ZMQ_SNDMORE : 0);
    std::vector<std::string> reply;
    int more = 1;
    while (more != 0) {
      std::string part(65'536, '\0');
      const int size = zmq_recv(socket_, part.data(), part.size(), 0);
      if (size < 0) return {"no answer"};
      reply.push_back(part.substr(0, static_cast<std::size_t>(size)));
      std::size_t length = sizeof more;
      zmq_getsockopt(socket_, ZMQ_RCVMORE, &more, &length);
    }
    return reply;
  }

 private:
  void* context_;
  void* socket_;
};

TEST(GrootServerTest, AnswersAClientOverTheSocket) {
  ASSERT_TRUE(hasGrootServer());
  GrootServer server("127.0.0.1", 0);
  EXPECT_GT(server.port(), 0);
  std::jthread serving([&server](const std::stop_token& stop) {
    GrootMonitor monitor("");
    monitor.update("GoAndSee", visitTree(), at(1.0));
    while (!stop.stop_requested()) server.serve(monitor, 10);
  });
  GrootClient client(server.port());
  EXPECT_THAT(client.ask({requestOf('T')}).at(1), HasSubstr("<MoveToGoal name=\"to &lt;door&gt;\" _uid=\"5\""));
  EXPECT_THAT(statusesOf(client.ask({requestOf('S', "wxyz")}).at(1)), ElementsAre(1, 4, 1, 1, 1, 0));
  EXPECT_THAT(client.ask({requestOf('S', "wxyz")}).at(0), StartsWith("\x02Swxyz"));
  EXPECT_EQ(client.ask({"nonsense"}).at(0), "error");
  EXPECT_THAT(nlohmann::json::from_msgpack(client.ask({requestOf('B'), "Visit::3"}).at(1)).dump(), HasSubstr("3;-1.5"));
}

TEST(GrootServerTest, SaysWhenThePortIsTaken) {
  const GrootServer first("127.0.0.1", 0);
  EXPECT_THAT(test_support::problemsOf([&] { const GrootServer second("127.0.0.1", first.port()); }),
              testing::ElementsAre(test_support::ProblemIs("server.cannot-listen", "--groot")));
}

#else

TEST(GrootServerTest, SaysWhatIsMissing) {
  EXPECT_FALSE(hasGrootServer());
  EXPECT_THROW(GrootServer("127.0.0.1", 0), common::InputError);
}

#endif

}  // namespace
}  // namespace swiftlet::interfaces
