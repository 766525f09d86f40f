// Reads subjects and cars of scenarios/ for tests.
#pragma once

#include <string>

#include "common/body_description.h"
#include "common/config.h"
#include "common/vehicle_front.h"
#include "tests/source_folder.h"

namespace crosswalk {

inline ConfigDocument subject_document(const std::string& subject, const std::string& more = {}) {
  return ConfigDocument::from_text("[subject]\nbase = \"" + subject + ".toml\"\n" + more,
                                   "test.toml", source_folder() / "scenarios/subjects");
}

inline BodyDescription load_subject(const std::string& subject, const std::string& more = {}) {
  ConfigDocument document = subject_document(subject, more);
  BodyDescription body = read_body_description(document.root().table("subject", "subject"));
  document.finish();
  return body;
}

inline VehicleFront load_front(const std::string& vehicle) {
  ConfigDocument document =
      ConfigDocument::from_text("[vehicle]\nbase = \"" + vehicle + ".toml\"\n", "test.toml",
                                source_folder() / "scenarios/vehicles");
  VehicleFront front = read_vehicle_front(document.root().table("vehicle", "car"));
  document.finish();
  return front;
}

}  // namespace crosswalk
