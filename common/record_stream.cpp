#include "common/record_stream.h"

#include <algorithm>

#include "common/error.h"
#include "crosswalk/msg/body_states.hpp"
#include "crosswalk/msg/contact_forces.hpp"
#include "crosswalk/msg/node_description.hpp"
#include "crosswalk/msg/run_event.hpp"
#include "crosswalk/msg/tissue_strain.hpp"

namespace crosswalk {

void RecordStream::head(const HeadSample& sample) {
  batch_.sample[batch_.n++] = to_message(sample);
  if (batch_.n == static_cast<int>(std::size(batch_.sample))) flush();
}

void RecordStream::flush() {
  if (batch_.n == 0) return;
  publish(batch_);
  batch_ = msg::head_kinematics{};
}

void RecordStream::body_states(std::int64_t t_ns, const std::vector<Pose>& X_WB) {
  constexpr int kSlice = static_cast<int>(std::size(decltype(msg::body_states::position){}));
  const int total = static_cast<int>(X_WB.size());
  for (int first = 0; first < total; first += kSlice) {
    msg::body_states m{};
    m.t_ns = t_ns;
    m.first = first;
    m.n = std::min(kSlice, total - first);
    m.n_total = total;
    for (int i = 0; i < m.n; ++i) {
      const Pose& X = X_WB[static_cast<std::size_t>(first + i)];
      for (int k = 0; k < 3; ++k) m.position[i][k] = static_cast<float>(X.p[k]);
      m.quaternion[i][0] = static_cast<float>(X.q.w());
      for (int k = 0; k < 3; ++k) m.quaternion[i][k + 1] = static_cast<float>(X.q.vec()[k]);
    }
    publish(m);
  }
}

void RecordStream::contact_forces(std::int64_t t_ns, const std::vector<Vec3>& forces) {
  msg::contact_forces m{};
  CW_ASSERT(forces.size() <= std::size(m.force));
  m.t_ns = t_ns;
  m.n = static_cast<int>(forces.size());
  for (std::size_t i = 0; i < forces.size(); ++i) {
    for (int k = 0; k < 3; ++k) m.force[i][k] = static_cast<float>(forces[i][k]);
  }
  publish(m);
}

void RecordStream::tissue(const TissueSample& sample) { publish(to_message(sample)); }

void RecordStream::event(std::int64_t t_ns, EventLevel level, const std::string& text) {
  msg::run_event m{};
  m.t_ns = t_ns;
  m.level = static_cast<std::int16_t>(level);
  m.text = wire_text(text);
  publish(m);
}

void RecordStream::describe(const std::string& json) {
  constexpr std::size_t kPiece = kDescriptionPieceBytes;
  const std::size_t pieces = std::max<std::size_t>(1, (json.size() + kPiece - 1) / kPiece);
  for (std::size_t i = 0; i < pieces; ++i) {
    msg::node_description m{};
    m.part = static_cast<int>(i);
    m.n_parts = static_cast<int>(pieces);
    m.text = json.substr(i * kPiece, kPiece);
    publish(m);
  }
}

void RecordStream::resend(std::int64_t first, std::int64_t last) {
  constexpr std::int64_t kAtOnce = 256;
  first = std::max(first, before_);
  last = std::min({last, count() - 1, first + kAtOnce - 1});
  for (std::int64_t i = first; i <= last; ++i) {
    const Kept& kept = kept_[static_cast<std::size_t>(i - before_)];
    bus_.send(kept.kind, kept.bytes);
  }
}

}  // namespace crosswalk
