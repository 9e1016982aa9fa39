// A chat-completions server on localhost that says what a test tells it to, and misbehaves on request.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace stub {

// What is sent for one request: raw bytes, after a delay; then the connection is closed.
struct Reply {
  std::string bytes;
  double delay_s = 0;
};

std::string http(int status, const std::string& body, const std::string& headers = "");
std::string chat(const std::string& text, const std::string& finish = "stop");  // a whole good answer

class Server {
 public:
  // `answer` is given the body of the n-th request, from 0.
  explicit Server(std::function<Reply(int, const std::string&)> answer);
  ~Server();
  std::string url() const;
  int requests() const { return count_; }
  std::vector<std::string> heads() const;  // of the requests

 private:
  void serve();
  void handle(int connection);
  std::function<Reply(int, const std::string&)> answer_;
  int socket_ = -1, port_ = 0;
  std::atomic<bool> stop_ = false;
  std::atomic<int> count_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::string> heads_;
  std::thread thread_;
};

}  // namespace stub
