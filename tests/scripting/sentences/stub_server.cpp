#include "stub_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace stub {

std::string http(int status, const std::string& body, const std::string& headers) {
  return "HTTP/1.1 " + std::to_string(status) + " Said\r\nContent-Type: application/json\r\nConnection: close\r\n" +
         headers + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string chat(const std::string& text, const std::string& finish) {
  const nlohmann::json body = {
      {"choices", {{{"message", {{"role", "assistant"}, {"content", text}}}, {"finish_reason", finish}}}},
      {"usage", {{"prompt_tokens", 100}, {"completion_tokens", 20}}}};
  return http(200, body.dump());
}

Server::Server(std::function<Reply(int, const std::string&)> answer) : answer_(std::move(answer)) {
  socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(socket_, 8) != 0 ||
      getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("the stub server cannot listen");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { serve(); });
}

Server::~Server() {
  stop_ = true;
  thread_.join();
  close(socket_);
}

std::string Server::url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/v1"; }

std::vector<std::string> Server::heads() const {
  const std::lock_guard lock(mutex_);
  return heads_;
}

void Server::serve() {
  while (!stop_) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0) continue;
    const int connection = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) continue;
    handle(connection);
    close(connection);
  }
}

void Server::handle(int connection) {
  std::string request;
  std::size_t head = std::string::npos, length = 0;
  char buffer[65536];
  while (!stop_) {
    pollfd waiting{connection, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0) continue;
    const ssize_t got = recv(connection, buffer, sizeof buffer, 0);
    if (got <= 0) return;
    request.append(buffer, static_cast<std::size_t>(got));
    if (head == std::string::npos && (head = request.find("\r\n\r\n")) != std::string::npos) {
      const std::size_t at = request.find("Content-Length: ");
      length = at == std::string::npos ? 0 : std::stoul(request.substr(at + 16));
      if (request.find("Expect: 100-continue") != std::string::npos)
        send(connection, "HTTP/1.1 100 Continue\r\n\r\n", 25, MSG_NOSIGNAL);
    }
    if (head != std::string::npos && request.size() >= head + 4 + length) break;
  }
  {
    const std::lock_guard lock(mutex_);
    heads_.push_back(request.substr(0, head));
  }
  const Reply reply = answer_(count_++, request.substr(head == std::string::npos ? 0 : head + 4));
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(reply.delay_s);
  while (!stop_ && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (std::size_t sent = 0; sent < reply.bytes.size() && !stop_;) {
    const ssize_t n = send(connection, reply.bytes.data() + sent, reply.bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return;
    sent += static_cast<std::size_t>(n);
  }
}

}  // namespace stub
