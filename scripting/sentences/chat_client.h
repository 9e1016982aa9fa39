// Asks a language model behind the usual chat-completions interface: llama.cpp's server, vLLM, Ollama, hosted ones.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stampede {

struct ChatSettings {
  std::string url;                     // `http://localhost:8080/v1`; `/chat/completions` is added
  std::string model;                   // its name, as the server knows it
  std::string key;                     // empty: none. Never printed, never stored, in no error.
  double timeout_s = 120;              // a request, from the first byte to the last
  int retries = 4;                     // of a server that is away, slow, busy or broken
  double wait_s = 1;                   // before the first retry; doubled each time
  double longest_wait_s = 60;          // also for what a server says in Retry-After
  double requests_per_minute = 0;      // at most; 0: as fast as it answers
  std::int64_t most_bytes = 1 << 20;   // of an answer: a longer one is ended as it comes in
  double price_in = 0, price_out = 0;  // a million tokens of prompt, of completion
};

struct ChatMessage {
  std::string role, text;  // system, user, assistant
};

struct ChatRequest {
  std::vector<ChatMessage> messages;
  int most_tokens = 512;
  double temperature = 0.8;
  std::int64_t seed = 0;
  std::string json_schema = {};  // the answer is to be of this form; servers that cannot leave it alone
};

// What came back. A server that answers, whatever it says, is no error: `problem` says what is wrong with it.
struct ChatAnswer {
  std::string text;
  std::string problem;  // empty: none. `no JSON`, `too long`, `no choices`, `no text`
  bool cut = false;     // it stopped at most_tokens
  bool ok() const { return problem.empty(); }
};

struct ChatCost {
  std::int64_t requests = 0, retries = 0, prompt_tokens = 0, completion_tokens = 0;
  double seconds = 0;  // waited for answers
  double price(const ChatSettings& settings) const;
};

// One at a time, from one thread. TLS as libcurl does it; redirects are not followed, so that the key goes nowhere
// else.
class ChatClient {
 public:
  // Throws Error for an address that is none.
  explicit ChatClient(ChatSettings settings);
  ~ChatClient();
  // Throws Error, with the cure: nobody there after all retries, the key or the model refused, no such address,
  // stopped (`stop` true; place `interrupted`).
  ChatAnswer ask(const ChatRequest& request, const std::atomic<bool>* stop);
  const ChatCost& cost() const { return cost_; }
  const ChatSettings& settings() const { return settings_; }

 private:
  struct Reply;
  Reply post(const std::string& body, const std::atomic<bool>* stop);
  ChatAnswer read(const Reply& reply);
  void wait(double seconds, const std::atomic<bool>* stop) const;
  std::string without_key(std::string text) const;
  ChatSettings settings_;
  std::string shown_url_;  // without user, password and query
  ChatCost cost_;
  double last_request_s_ = -1e9;
  void* handle_ = nullptr;
};

}  // namespace stampede
