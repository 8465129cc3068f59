#include "server/hosts.hpp"

#include <gtest/gtest.h>

namespace qdot::server {
namespace {

TEST(Hosts, ALoopbackServerAnswersToItsOwnNamesOnly) {
  const Hosts hosts({.bound = "127.0.0.1", .port = 8080});
  for (const char* own :
       {"localhost:8080", "127.0.0.1:8080", "[::1]:8080", "LocalHost:8080", "localhost", "127.0.0.1"})
    EXPECT_TRUE(hosts.allow(own)) << own;
  for (const char* foreign : {"localhost:8081", "evil.example:8080", "evil.example",
                              "localhost.evil.example:8080", "127.0.0.1.nip.io:8080", "", ":8080",
                              "localhost:8080:8080", "[::1", "::1", "0.0.0.0:8080", "localhost@evil.example"})
    EXPECT_FALSE(hosts.allow(foreign)) << foreign;
}

TEST(Hosts, ListedNamesAreAllowedToo) {
  const Hosts hosts({.bound = "0.0.0.0", .port = 8080, .allowed = {"Grader.local", "course.example:443"}});
  for (const char* name : {"grader.local", "grader.local:1", "course.example:443", "localhost:8080"})
    EXPECT_TRUE(hosts.allow(name)) << name;
  for (const char* name : {"course.example", "course.example:80", "other.local"})
    EXPECT_FALSE(hosts.allow(name)) << name;
}

TEST(Hosts, ElsewhereNamesAreNotOursToKnow) {
  const Hosts hosts({.bound = "0.0.0.0", .port = 8080});
  EXPECT_TRUE(hosts.allow("anything.example"));
  EXPECT_TRUE(hosts.allow_origin("http://anything.example", "anything.example"));
  EXPECT_FALSE(hosts.allow_origin("http://localhost:8080", "anything.example"));
}

TEST(Hosts, AnOriginIsThisSiteOrForeign) {
  const Hosts hosts({.bound = "localhost", .port = 8080});
  EXPECT_TRUE(hosts.allow_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(hosts.allow_origin("http://127.0.0.1:8080", "localhost:8080"));
  for (const char* foreign : {"http://localhost", "http://localhost:3000", "https://evil.example", "null", "",
                              "localhost:8080", "http://localhost:8080.evil.example"})
    EXPECT_FALSE(hosts.allow_origin(foreign, "localhost:8080")) << foreign;
}

TEST(Hosts, OnAUnixSocketAnyPortWillDo) {
  const Hosts hosts({.port = 0});
  EXPECT_TRUE(hosts.allow("localhost"));
  EXPECT_TRUE(hosts.allow("localhost:1"));
  EXPECT_FALSE(hosts.allow("evil.example"));
}

}  // namespace
}  // namespace qdot::server
