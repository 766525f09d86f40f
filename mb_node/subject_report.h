// What became of a subject's measures: `mb_node subject FILE`.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "common/body_description.h"

namespace crosswalk::mb {

/// What was measured on another, published model after its own scaling to the same subject; by
/// measure, SI. Empty when the file has no column of that name.
using PublishedScaling = std::map<std::string, double>;
PublishedScaling read_published_scaling(const std::filesystem::path& file,
                                        const std::string& subject);

/// Largest difference between asked and obtained of the heights and lengths, m.
struct WorstLength {
  std::string measure;
  double difference = 0;
};
WorstLength worst_length(const BodyDescription& body);
WorstLength worst_length(const Anthropometry& asked, const PublishedScaling& published);

std::string subject_report(const BodyDescription& body, const PublishedScaling& published);

}  // namespace crosswalk::mb
