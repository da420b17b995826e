// What may be given as a public address of the page, and what is refused with which hint.
#include "web/server/public_url.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"

namespace swiftlet::web {
namespace {

TEST(PublicUrlTest, IsHostPortAndPath) {
  const PublicUrl url = parsePublicUrl("https://field.example/swiftlet/");
  EXPECT_EQ(url.origin, (Origin{"https", "field.example", 443}));
  EXPECT_EQ(url.path, "/swiftlet/");
  EXPECT_EQ(url.text, "https://field.example/swiftlet/");
  const std::pair<const char*, const char*> written[] = {
      {"https://field.example", "https://field.example/"},
      {"https://field.example/swiftlet", "https://field.example/swiftlet/"},
      {"https://field.example/swiftlet/index.html", "https://field.example/swiftlet/"},
      {"HTTPS://Field.Example.:443/Swiftlet", "https://field.example/Swiftlet/"},
      {"http://drone.local:8080", "http://drone.local:8080/"},
      {"http://drone.local:80/", "http://drone.local/"},
      {"https://192.168.1.20:8443/a/b", "https://192.168.1.20:8443/a/b/"},
      {"http://[FD00:0:0::1]:8080/", "http://[fd00::1]:8080/"},
      {"http://swiftlet_app/robot%201/", "http://swiftlet_app/robot%201/"},
  };
  for (const auto& [text, shown] : written) EXPECT_EQ(parsePublicUrl(text).text, shown) << text;
  EXPECT_EQ(parsePublicUrl("http://swiftlet_app/robot%201/").path, "/robot 1/") << "as a request's path is compared";
}

std::string problemOf(const std::string& text) {
  try {
    parsePublicUrl(text);
  } catch (const common::InputError& error) {
    EXPECT_EQ(error.problems().front().element, "--public-url");
    return error.problems().front().hint;
  }
  return "";
}

TEST(PublicUrlTest, BadOnesAreRefusedWithAHintThatWorks) {
  const std::pair<const char*, const char*> hints[] = {
      {"field.example/swiftlet/", "write http://field.example/swiftlet/ or https://field.example/swiftlet/"},
      {"drone.local:8080", "write http://drone.local:8080 or https://drone.local:8080"},
      {"httpbin.local:8080", "write http://httpbin.local:8080 or https://httpbin.local:8080"},
      {"//field.example/", "write http://field.example/ or https://field.example/"},
      {"https:/field.example/", "write http://field.example/ or https://field.example/"},
      {"wss://field.example/swiftlet/", "write https://field.example/swiftlet/"},
      {"ws://field.example:81/", "write http://field.example:81/"},
      {"ftp://field.example/", "write https://field.example/"},
      {"https://field.example/swiftlet/?token=abc", "write https://field.example/swiftlet/"},
      {"https://field.example/swiftlet#map", "write https://field.example/swiftlet/"},
      {"https://field.example?x", "write https://field.example/"},
      {"https://pilot:secret@field.example/swiftlet/?x", "write https://field.example/swiftlet/"},
  };
  for (const auto& [text, hint] : hints) {
    EXPECT_EQ(problemOf(text), hint) << text;
    const std::string written = std::string(hint).substr(6);
    EXPECT_NO_THROW(parsePublicUrl(written.substr(0, written.find(' ')))) << "what the hint says for " << text;
  }
  for (const char* text : {"", "https://", "https:///swiftlet/", "https://*.example/", "https://a b/", "http://[::1/",
                           "http://[::1%25eth0]/", "https://field.example:0/", "https://field.example:70000/",
                           "https://field.example:x/", "https://field.example/../x/", "https://field.example/a//b/",
                           "https://field.example/%zz/", "https://dr\xc3\xb6hne.example/", "http", "/"})
    EXPECT_NE(problemOf(text), "") << text;
}

TEST(OriginTest, IsComparedAsBrowsersDo) {
  EXPECT_EQ(parseOrigin("https://Field.Example:443"), parseOrigin("https://field.example"));
  EXPECT_EQ(parseOrigin("http://[0:0::1]:80"), parseOrigin("http://[::1]"));
  EXPECT_NE(parseOrigin("https://field.example"), parseOrigin("http://field.example"));
  EXPECT_NE(parseOrigin("https://field.example"), parseOrigin("https://field.example:8443"));
  for (const char* text : {"", "null", "field.example", "file://", "chrome-extension://abcdef", "https://a/b",
                           "https://a?b", "https://u@a", "https://a:x", "wss://a", "https://a https://b"})
    EXPECT_FALSE(parseOrigin(text)) << text;
  EXPECT_EQ(toString(*parseOrigin("HTTPS://[FD00::1]:443")), "https://[fd00::1]");
  EXPECT_EQ(toString(*parseOrigin("http://Drone.local:8080")), "http://drone.local:8080");
}

}  // namespace
}  // namespace swiftlet::web
