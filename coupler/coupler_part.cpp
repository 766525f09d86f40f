#include "coupler/coupler_part.h"

namespace crosswalk::coupling {

void save_part(const std::filesystem::path& checkpoints, std::int64_t window,
               const Coupler& coupler, const LcmMbLink& mb, const LcmFeLink& fe, const Hub& hub) {
  ByteWriter out;
  out.value(mb.last_seq());
  out.value(mb.mobility_id());
  out.value(fe.last_seq());
  coupler.save(out);
  write_part(checkpoints, Role::Coupler,
             {window, mb.last_seq(), hub.records().count(), out.take()});
  commit_checkpoint(checkpoints, window);
}

void load_part(const CheckpointPart& part, Coupler& coupler, LcmMbLink& mb, LcmFeLink& fe,
               Hub& hub) {
  ByteReader in(part.state);
  const auto mb_seq = in.take<std::int64_t>();
  const auto mobility_id = in.take<int>();
  const auto fe_seq = in.take<std::int64_t>();
  coupler.load(in);
  mb.continue_from(mb_seq, mobility_id, coupler.state().mobility);
  fe.continue_from(fe_seq);
  hub.records().continue_from(part.n_records);
}

}  // namespace crosswalk::coupling
