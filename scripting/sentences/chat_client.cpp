#include "scripting/sentences/chat_client.h"

#include <curl/curl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/read_json.h"

namespace stampede {
namespace {

using nlohmann::json;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool stopped(const std::atomic<bool>* stop) { return stop != nullptr && stop->load(std::memory_order_relaxed); }

struct Receiver {
  std::string body;
  std::int64_t most_bytes = 0;
  bool too_long = false;
  std::optional<double> retry_after_s;
  const std::atomic<bool>* stop = nullptr;
};

std::size_t take_body(char* data, std::size_t size, std::size_t count, void* user) {
  auto& receiver = *static_cast<Receiver*>(user);
  const std::size_t bytes = size * count;
  if (static_cast<std::int64_t>(receiver.body.size() + bytes) > receiver.most_bytes) {
    receiver.too_long = true;
    return 0;  // ends the transfer
  }
  receiver.body.append(data, bytes);
  return bytes;
}

// Retry-After: seconds, or a date (RFC 9110, section 10.2.3).
std::size_t take_header(char* data, std::size_t size, std::size_t count, void* user) {
  std::string line(data, size * count);
  std::transform(line.begin(), line.end(), line.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (line.starts_with("retry-after:")) {
    const std::string value =
        line.substr(line.find_first_not_of(" \t", 12) == std::string::npos ? 12 : line.find_first_not_of(" \t", 12));
    char* end = nullptr;
    const double seconds = std::strtod(value.c_str(), &end);
    auto& receiver = *static_cast<Receiver*>(user);
    if (end != value.c_str() && std::isfinite(seconds)) {
      receiver.retry_after_s = std::max(0.0, seconds);
    } else if (const std::time_t at = curl_getdate(value.c_str(), nullptr); at >= 0) {
      receiver.retry_after_s = std::max(0.0, std::difftime(at, std::time(nullptr)));
    }
  }
  return size * count;
}

int watch(void* user, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return stopped(static_cast<Receiver*>(user)->stop) ? 1 : 0;
}

// Scheme, host and path; who one is and what one asks stay out of messages.
std::string without_secrets(const std::string& url) {
  std::string shown = url.substr(0, url.find_first_of("?#"));
  const std::size_t host = shown.find("://") + 3;
  const std::size_t path = shown.find('/', host);
  const std::size_t at = shown.rfind('@', path);
  if (at != std::string::npos && at >= host) shown.erase(host, at + 1 - host);
  return shown;
}

std::string body_of(const ChatRequest& request, const std::string& model) {
  json body = {{"model", model},
               {"max_tokens", request.most_tokens},
               {"temperature", request.temperature},
               {"seed", request.seed},
               {"messages", json::array()}};
  for (const ChatMessage& message : request.messages)
    body["messages"].push_back({{"role", message.role}, {"content", message.text}});
  if (!request.json_schema.empty())
    body["response_format"] = {
        {"type", "json_schema"},
        {"json_schema", {{"name", "answer"}, {"schema", json_from_text(request.json_schema, "", "")}}}};
  return body.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

struct ChatClient::Reply {
  CURLcode code = CURLE_OK;
  long status = 0;
  Receiver received;
};

double ChatCost::price(const ChatSettings& settings) const {
  return 1e-6 * (settings.price_in * static_cast<double>(prompt_tokens) +
                 settings.price_out * static_cast<double>(completion_tokens));
}

ChatClient::ChatClient(ChatSettings settings) : settings_(std::move(settings)) {
  std::string& url = settings_.url;
  if (!url.starts_with("http://") && !url.starts_with("https://"))
    throw Error("--url", "that is no address of a server", "write one such as http://localhost:8080/v1");
  while (url.ends_with('/')) url.pop_back();
  if (!url.ends_with("/chat/completions")) url += "/chat/completions";
  shown_url_ = without_secrets(url);
  static const CURLcode ready = curl_global_init(CURL_GLOBAL_DEFAULT);
  handle_ = ready == CURLE_OK ? curl_easy_init() : nullptr;
  if (handle_ == nullptr) throw Error(shown_url_, "libcurl does not start", "look at its installation");
}

ChatClient::~ChatClient() { curl_easy_cleanup(static_cast<CURL*>(handle_)); }

std::string ChatClient::without_key(std::string text) const {
  if (settings_.key.empty()) return text;
  for (std::size_t at = text.find(settings_.key); at != std::string::npos; at = text.find(settings_.key, at))
    text.replace(at, settings_.key.size(), "…");
  return text;
}

void ChatClient::wait(double seconds, const std::atomic<bool>* stop) const {
  const double until = now_s() + seconds;
  while (now_s() < until) {
    if (stopped(stop)) throw Error("interrupted", "stopped while waiting for " + shown_url_);
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(0.05, std::max(0.001, until - now_s()))));
  }
}

ChatClient::Reply ChatClient::post(const std::string& body, const std::atomic<bool>* stop) {
  CURL* curl = static_cast<CURL*>(handle_);
  curl_easy_reset(curl);
  Reply reply;
  reply.received.most_bytes = settings_.most_bytes;
  reply.received.stop = stop;
  curl_slist* headers = curl_slist_append(nullptr, "Content-Type: application/json");
  headers = curl_slist_append(headers, "Accept: application/json");
  if (!settings_.key.empty()) headers = curl_slist_append(headers, ("Authorization: Bearer " + settings_.key).c_str());
  curl_easy_setopt(curl, CURLOPT_URL, settings_.url.c_str());
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers);
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "stampede");
  curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body.c_str());
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_TIMEOUT_MS, static_cast<long>(1000 * settings_.timeout_s));
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(1000 * std::min(10.0, settings_.timeout_s)));
  curl_easy_setopt(curl, CURLOPT_MAXFILESIZE_LARGE, static_cast<curl_off_t>(settings_.most_bytes));
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, take_body);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, &reply.received);
  curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, take_header);
  curl_easy_setopt(curl, CURLOPT_HEADERDATA, &reply.received);
  curl_easy_setopt(curl, CURLOPT_XFERINFOFUNCTION, watch);
  curl_easy_setopt(curl, CURLOPT_XFERINFODATA, &reply.received);
  curl_easy_setopt(curl, CURLOPT_NOPROGRESS, 0L);
  reply.code = curl_easy_perform(curl);
  curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &reply.status);
  if (reply.code == CURLE_FILESIZE_EXCEEDED) reply.received.too_long = true;
  curl_slist_free_all(headers);
  return reply;
}

// What the server says, where it says it in the usual form; no more than a line, and not the key.
static std::string message_in(const std::string& body) {
  const json said = json_if_any(body).value_or(json());
  std::string text;
  if (said.is_null()) text = body;
  if (said.is_object() && said.contains("error")) {
    const json& error = said["error"];
    if (error.is_string()) text = error.get<std::string>();
    if (error.is_object() && error.contains("message") && error["message"].is_string()) text = error["message"];
  }
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32; }, ' ');
  return text.substr(0, 200);
}

ChatAnswer ChatClient::read(const Reply& reply) {
  ChatAnswer answer;
  if (reply.received.too_long) {
    answer.problem = "too long";
    return answer;
  }
  const json said = json_if_any(reply.received.body).value_or(json());
  if (!said.is_object()) {
    answer.problem = "no JSON";
    return answer;
  }
  if (said.contains("usage") && said["usage"].is_object()) {
    const auto count = [&](const char* name) {
      const json& usage = said["usage"];
      return usage.contains(name) && usage[name].is_number_integer() ? std::max<std::int64_t>(0, usage[name]) : 0;
    };
    cost_.prompt_tokens += count("prompt_tokens");
    cost_.completion_tokens += count("completion_tokens");
  }
  if (!said.contains("choices") || !said["choices"].is_array() || said["choices"].empty()) {
    answer.problem = "no choices";
    return answer;
  }
  const json& choice = said["choices"].front();
  const bool has_text = choice.is_object() && choice.contains("message") && choice["message"].is_object() &&
                        choice["message"].contains("content") && choice["message"]["content"].is_string();
  if (!has_text) {
    answer.problem = "no text";
    return answer;
  }
  answer.text = without_key(choice["message"]["content"]);
  answer.cut = choice.contains("finish_reason") && choice["finish_reason"] == "length";
  return answer;
}

ChatAnswer ChatClient::ask(const ChatRequest& request, const std::atomic<bool>* stop) {
  const std::string body = body_of(request, settings_.model);
  double pause = settings_.wait_s;
  std::string last;
  bool busy = false;
  for (int attempt = 0; attempt <= settings_.retries; ++attempt) {
    if (settings_.requests_per_minute > 0)
      wait(std::max(0.0, last_request_s_ + 60 / settings_.requests_per_minute - now_s()), stop);
    if (stopped(stop)) throw Error("interrupted", "stopped before asking " + shown_url_);
    last_request_s_ = now_s();
    const Reply reply = post(body, stop);
    cost_.seconds += now_s() - last_request_s_;
    ++cost_.requests;
    if (reply.code == CURLE_ABORTED_BY_CALLBACK) throw Error("interrupted", "stopped while asking " + shown_url_);
    if (reply.received.too_long || (reply.code == CURLE_OK && reply.status == 200)) return read(reply);
    double wait_s = std::min(pause, settings_.longest_wait_s);
    if (reply.code != CURLE_OK) {
      last = curl_easy_strerror(reply.code);
    } else {
      const std::string said = without_key(message_in(reply.received.body));
      last = "status " + std::to_string(reply.status) + (said.empty() ? "" : ": " + said);
      if (reply.status == 401 || reply.status == 403)
        throw Error(shown_url_, last, "the key is in STAMPEDE_LLM_KEY: is it there, and right?");
      if (reply.status >= 300 && reply.status < 400)
        throw Error(shown_url_, last + ": it sends elsewhere",
                    "redirects are not followed: name that address by --url");
      const bool passing = reply.status == 408 || reply.status == 429 || reply.status >= 500;
      if (!passing) throw Error(shown_url_, last, "look at --url (it ends in /v1, mostly) and at --model");
      busy = reply.status == 429;
      if (reply.received.retry_after_s) wait_s = *reply.received.retry_after_s;
      if (wait_s > settings_.longest_wait_s)
        throw Error(shown_url_, last + "; it asks to wait " + std::to_string(static_cast<int>(wait_s)) + " s",
                    "run the same command then: what is done is kept");
    }
    if (attempt == settings_.retries) break;
    ++cost_.retries;
    wait(wait_s, stop);
    pause *= 2;
  }
  throw Error(shown_url_, "no answer after " + std::to_string(settings_.retries + 1) + " requests: " + last,
              (busy ? "it is too busy: ask less often with --rate, or more often again with --retries"
                    : "is the server running, and is it --timeout that ends it?") +
                  std::string(" What is done is kept"));
}

}  // namespace stampede
