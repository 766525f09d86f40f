#include "coupler/broker_command.h"

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/interrupt.h"
#include "coupler/broker.h"

namespace crosswalk {

namespace {

ExitCode serve(const std::string& listen) {
  catch_interrupts();
  const tcpq::Address address = tcpq::address_from(listen);
  Broker broker(address);
  fmt::print("listening; give every process --lcm-url tcpq://{}:{} (Ctrl-C ends the broker)\n",
             address.host, broker.port());
  std::fflush(stdout);
  broker.serve(interrupt_flag());
  return ExitCode::Done;
}

}  // namespace

NodeCommand broker_command() {
  return {.name = "broker",
          .purpose = "Hand messages between machines without multicast (LCM's tcpq protocol).",
          .define = [](CLI::App& app) -> std::function<ExitCode()> {
            auto listen =
                std::make_shared<std::string>(fmt::format("127.0.0.1:{}", tcpq::kDefaultPort));
            app.add_option("--listen", *listen,
                           "Address and port; anyone who reaches it can take part in runs, so "
                           "this machine alone by default (docs/distributed.md: tunnels)")
                ->capture_default_str();
            return [listen] { return serve(*listen); };
          }};
}

}  // namespace crosswalk
