#pragma once

#include <string>

namespace lcmslam {

// SCHEME://HOST:PORT?OPTION=VALUE&... as liblcm takes it. What a udpm URL leaves out is filled in as liblcm does.
struct LcmUrl {
  std::string text;
  std::string scheme, host, port;  // "": not given
  std::string options;             // "OPTION=VALUE&..."

  // The value of an option, "" when it is not there.
  std::string Option(const std::string& name) const;
};

// "" means $LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2097152. Throws CommandError: kUsage
// for a malformed URL, kRuntime where no tcpq server answers. liblcm falls back silently on bad addresses, and aborts
// without a server.
LcmUrl CheckedLcmUrl(const std::string& text);

}  // namespace lcmslam
