// LCM as the transport: UDP multicast, or the memory of one process for tests.
#pragma once

#include <memory>
#include <string>

#include "common/transport.h"

namespace crosswalk {

/// Throws ProtocolError{NoTransport} with the cure when LCM cannot start.
std::shared_ptr<Transport> lcm_transport(const std::string& url);
/// LCM as it comes, without the filter in front of its socket: what benchmarks compare with.
std::shared_ptr<Transport> plain_lcm_transport(const std::string& url);

}  // namespace crosswalk
