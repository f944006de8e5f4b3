// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>

namespace polargrain::testing {

/// A port of this machine for tests that must name one before it is opened. It lies below those that the system gives
/// to connections: one that has ended keeps its port for a minute.
inline int free_port() {
  constexpr int kFirst = 20000, kCount = 12000;
  for (int k = 0;; ++k) {
    const int port = kFirst + (static_cast<int>(getpid()) + k) % kCount;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    const bool is_free = bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(socket);
    if (is_free || k > kCount) return port;
  }
}

}  // namespace polargrain::testing
