// LCM as the transport: UDP multicast, or the memory of one process for tests.
#pragma once

#include <memory>
#include <string>

#include "common/transport.h"

namespace crosswalk {

/// Throws ProtocolError{NoTransport} with the cure when LCM cannot start.
std::shared_ptr<Transport> lcm_transport(const std::string& url);

}  // namespace crosswalk
