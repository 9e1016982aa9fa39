// The client and a server that misbehaves in every way.
#include <catch2/catch.hpp>
#include <chrono>

#include "engine/base/error.h"
#include "scripting/sentences/chat_client.h"
#include "stub_server.h"

using namespace stampede;
using Catch::Matchers::Contains;

namespace {

const std::string kKey = "sk-secret-0815";

ChatSettings settings(const std::string& url) {
  ChatSettings one;
  one.url = url;
  one.model = "small";
  one.key = kKey;
  one.timeout_s = 0.4;
  one.retries = 2;
  one.wait_s = 0.01;
  return one;
}

const ChatRequest kRequest{{{"user", "say it"}}};

std::string complaint(const std::function<stub::Reply(int, const std::string&)>& answer) {
  stub::Server server(answer);
  ChatClient client(settings(server.url()));
  try {
    client.ask(kRequest, nullptr);
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find(kKey) == std::string::npos);
    CHECK_FALSE(error.hint().empty());
    return error.what();
  }
  return "no complaint";
}

std::string problem(const std::string& bytes) {
  stub::Server server([&](int, const std::string&) { return stub::Reply{bytes}; });
  ChatClient client(settings(server.url()));
  return client.ask(kRequest, nullptr).problem;
}

}  // namespace

TEST_CASE("a good answer is read, and its cost counted") {
  stub::Server server([](int, const std::string& body) {
    CHECK_THAT(body, Contains("\"model\":\"small\"") && Contains("say it"));
    return stub::Reply{stub::chat("put it there", "length")};
  });
  ChatSettings priced = settings(server.url() + "/");
  priced.price_in = 10;
  priced.price_out = 100;
  ChatClient client(priced);
  const ChatAnswer answer = client.ask(kRequest, nullptr);
  CHECK(answer.text == "put it there");
  CHECK(answer.cut);
  CHECK(client.cost().requests == 1);
  CHECK(client.cost().prompt_tokens == 100);
  CHECK(client.cost().price(priced) == Approx(1e-6 * (1000 + 2000)));
  CHECK_THAT(server.heads().front(), Contains("POST /v1/chat/completions") && Contains("Bearer " + kKey));
}

TEST_CASE("a server that is away, slow or silent is asked again, and then told of with the cure") {
  ChatSettings nobody = settings("http://127.0.0.1:1/v1");
  ChatClient away(nobody);
  CHECK_THROWS_WITH(away.ask(kRequest, nullptr),
                    Contains("no answer after 3 requests") && Contains("is the server running"));
  CHECK(away.cost().requests == 3);
  CHECK_THAT(complaint([](int, const std::string&) {
               return stub::Reply{stub::chat("late"), 5};
             }),
             Contains("no answer after 3"));
  CHECK_THAT(complaint([](int, const std::string&) { return stub::Reply{""}; }), Contains("no answer after 3"));
  const std::string half = stub::chat("put it there").substr(0, 190);  // closes in the middle of the answer
  CHECK_THAT(complaint([&](int, const std::string&) { return stub::Reply{half}; }), Contains("no answer after 3"));
}

TEST_CASE("a key that is refused is named by its variable, and never shown") {
  const auto refuse = [](int, const std::string&) {
    return stub::Reply{stub::http(401, R"({"error": {"message": "bad key sk-secret-0815"}})")};
  };
  CHECK_THAT(complaint(refuse), Contains("status 401: bad key …") && Contains("STAMPEDE_LLM_KEY"));
  CHECK_THAT(
      complaint([](int, const std::string&) { return stub::Reply{stub::http(404, R"({"error": "no such model"})")}; }),
      Contains("status 404: no such model") && Contains("--model"));
  ChatClient client(settings("http://me:word@127.0.0.1:1/v1?key=abc"));
  CHECK_THROWS_WITH(client.ask(kRequest, nullptr), !Contains("word") && !Contains("abc"));
}

TEST_CASE("redirects are not followed: the key goes nowhere else") {
  stub::Server other([](int, const std::string&) { return stub::Reply{stub::chat("mine now")}; });
  CHECK_THAT(complaint([&](int, const std::string&) {
               return stub::Reply{stub::http(307, "", "Location: " + other.url() + "\r\n")};
             }),
             Contains("status 307"));
  CHECK(other.requests() == 0);
}

TEST_CASE("a busy or broken server is asked again after as long as it says") {
  stub::Server server([](int n, const std::string&) {
    if (n == 0) return stub::Reply{stub::http(429, "{}", "Retry-After: 0.3\r\n")};
    if (n == 1) return stub::Reply{stub::http(500, "oops")};
    return stub::Reply{stub::chat("well")};
  });
  ChatClient client(settings(server.url()));
  const auto start = std::chrono::steady_clock::now();
  CHECK(client.ask(kRequest, nullptr).text == "well");
  CHECK(std::chrono::steady_clock::now() - start > std::chrono::milliseconds(300));
  CHECK(client.cost().retries == 2);
  CHECK_THAT(
      complaint([](int, const std::string&) { return stub::Reply{stub::http(429, "{}", "Retry-After: 3600\r\n")}; }),
      Contains("wait 3600 s"));
}

TEST_CASE("nonsense is no error but an answer with a problem") {
  CHECK(problem(stub::http(200, "<html><body>It works!</body></html>")) == "no JSON");
  CHECK(problem(stub::http(200, "{\"choices\": [{\"mess")) == "no JSON");
  CHECK(problem(stub::http(200, "{\"choices\": [{\"message\": {\"content\": \"a \xff\xfe b\"}}]}")) == "no JSON");
  CHECK(problem(stub::http(200, "[1, 2]")) == "no JSON");
  CHECK(problem(stub::http(200, R"({"choices": []})")) == "no choices");
  CHECK(problem(stub::http(200, R"({"error": "no"})")) == "no choices");
  CHECK(problem(stub::http(200, R"({"choices": [{"message": {"content": null}}]})")) == "no text");
  CHECK(problem(stub::http(200, R"({"choices": [7], "usage": {"prompt_tokens": -5}})")) == "no text");
}

TEST_CASE("ten megabytes are ended as they come in") {
  CHECK(problem(stub::http(200, std::string(10'000'000, 'x'))) == "too long");
  std::string endless =
      "HTTP/1.1 200 OK\r\nConnection: close\r\n\r\n" + std::string(10'000'000, 'x');  // of no stated length
  CHECK(problem(endless) == "too long");
}

TEST_CASE("a signal ends waiting") {
  std::atomic<bool> stop = false;
  stub::Server server([&](int, const std::string&) {
    stop = true;
    return stub::Reply{stub::chat("late"), 5};
  });
  ChatSettings patient = settings(server.url());
  patient.timeout_s = 30;
  ChatClient client(patient);
  try {
    client.ask(kRequest, &stop);
    FAIL("it did not stop");
  } catch (const Error& error) {
    CHECK(error.where() == "interrupted");
  }
}

TEST_CASE("the rate is kept") {
  stub::Server server([](int, const std::string&) { return stub::Reply{stub::chat("well")}; });
  ChatSettings slow = settings(server.url());
  slow.requests_per_minute = 300;  // one in 0.2 s
  ChatClient client(slow);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) client.ask(kRequest, nullptr);
  CHECK(std::chrono::steady_clock::now() - start > std::chrono::milliseconds(390));
}

TEST_CASE("an address that is none is told of") {
  CHECK_THROWS_WITH(ChatClient(settings("localhost:8080")), Contains("no address") && Contains("http://"));
  CHECK_THROWS_WITH(ChatClient(settings("file:///etc/passwd")), Contains("no address"));
}
