#include "recorder/recorder.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "common/error.h"
#include "recorder/message_decode.h"

namespace crosswalk::recording {

namespace {

/// Done messages to ask for when an audit tells of a window whose grant number is unknown.
constexpr std::int64_t kBlindAsk = 64;

/// `log`, unless it holds a record that is not to be continued.
const std::filesystem::path& unused(const std::filesystem::path& log, const LogExtent& kept) {
  std::error_code none;
  if (kept.events == 0 && std::filesystem::file_size(log, none) > 0 && !none) {
    throw UserError({{log.string()},
                     "--out",
                     "a folder without a log",
                     "the log of an earlier run",
                     "choose another folder, or continue that run with --resume"});
  }
  return log;
}

MessageKind done_kind(Role role) {
  return role == Role::Mb ? MessageKind::MbDone : MessageKind::FeDone;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& log, std::int64_t run, const LogExtent& kept)
    : log_(unused(log, kept), kept), run_(run) {
  if (kept.events == 0) return;
  read_log(log, [this](const LogEvent& event) {
    const auto h = peek_header(event.data);
    if (h && h->run_id == run_) book(*h, event.data);
  });
}

std::vector<Role> Recorder::solvers() const {
  return has_fe_ ? std::vector<Role>{Role::Mb, Role::Fe} : std::vector<Role>{Role::Mb};
}

void Recorder::add(const std::string& channel, std::span<const std::byte> data,
                   std::int64_t arrival_us) {
  log_.write(arrival_us, channel, data);
  const auto h = peek_header(data);
  if (h && h->run_id == run_) book(*h, data);
}

void Recorder::book_done(Role role, const msg::header& h, std::int64_t window,
                         std::int64_t records) {
  Sender& sender = senders_[role];
  sender.done.add(h.seq);
  sender.granted = std::max(sender.granted, h.seq + 1);
  sender.announced = std::max(sender.announced, records);
  if (window <= complete_window_) return;
  Done& done = sender.windows[window];
  if (h.seq > done.seq) done = {h.seq, records};
}

void Recorder::book(const msg::header& h, std::span<const std::byte> data) {
  const auto kind = static_cast<MessageKind>(h.kind);
  const auto role = static_cast<Role>(h.sender);
  if (rule_of(kind).is_record) {
    Sender& sender = senders_[role];
    sender.records.add(h.seq);
    sender.announced = std::max(sender.announced, h.seq + 1);
  }
  // Bodies are looked at only where they tell something about completeness.
  switch (kind) {
    case MessageKind::MbDone:
      if (const auto m = decoded<msg::mb_done>(data))
        book_done(Role::Mb, h, m->window, m->n_records);
      break;
    case MessageKind::FeDone:
      if (const auto m = decoded<msg::fe_done>(data))
        book_done(Role::Fe, h, m->window, m->n_records);
      break;
    case MessageKind::CouplingAudit:
      if (const auto m = decoded<msg::coupling_audit>(data)) {
        if (m->window > complete_window_) audited_[m->window] = true;
        last_audit_ = std::max(last_audit_, m->window);
      }
      break;
    case MessageKind::RunManifest:
      if (!is_sound_manifest(data)) break;
      if (const auto m = decoded<msg::run_manifest>(data)) {
        has_manifest_ = true;
        has_fe_ = m->has_fe != 0;
      }
      break;
    case MessageKind::RunControl:
      if (const auto m = decoded<msg::run_control>(data);
          m && role == Role::Coupler && m->command == static_cast<int>(Command::Finish)) {
        last_window_ = std::max<std::int64_t>(m->window, -1);
      }
      break;
    case MessageKind::NodeStatus:
      if (const auto m = decoded<msg::node_status>(data)) {
        Sender& sender = senders_[role];
        sender.announced = std::max(sender.announced, m->n_records);
        if (m->state == static_cast<int>(NodeState::Done)) sender.is_done = true;
      }
      break;
    default:
      break;
  }
  advance();
}

bool Recorder::has_whole(const Sender& sender, std::int64_t window) const {
  const auto found = sender.windows.find(window);
  return found != sender.windows.end() && sender.done.complete() > found->second.seq &&
         sender.records.complete() >= found->second.records;
}

void Recorder::advance() {
  while (has_manifest_ && audited_.count(complete_window_ + 1) != 0) {
    const std::int64_t window = complete_window_ + 1;
    for (const Role role : solvers()) {
      const auto sender = senders_.find(role);
      if (sender == senders_.end() || !has_whole(sender->second, window)) return;
    }
    for (auto& [role, sender] : senders_) sender.windows.erase(window);
    audited_.erase(window);
    complete_window_ = window;
  }
}

std::vector<Gap> Recorder::gaps(std::size_t most) const {
  std::vector<Gap> out;
  for (const auto& [role, sender] : senders_) {
    if (role == Role::Recorder) continue;
    for (const auto& [first, last] : sender.records.missing(sender.announced, most)) {
      out.push_back({role, 0, first, last});
    }
  }
  for (const Role role : solvers()) {
    const auto found = senders_.find(role);
    const Numbers none;
    const Numbers& done = found == senders_.end() ? none : found->second.done;
    const std::int64_t granted = found == senders_.end() ? 0 : found->second.granted;
    for (const auto& [first, last] : done.missing(granted, most)) {
      out.push_back({role, static_cast<int>(done_kind(role)), first, last});
    }
    // The audit of a window proves that its done messages exist.
    const bool has_last =
        found != senders_.end() &&
        (last_audit_ <= complete_window_ || found->second.windows.count(last_audit_) != 0);
    if (last_audit_ >= 0 && !has_last) {
      out.push_back({role, static_cast<int>(done_kind(role)), granted, granted + kBlindAsk - 1});
    }
  }
  if (out.size() > most) out.resize(most);
  return out;
}

bool Recorder::is_complete() const {
  if (!has_finish() || complete_window_ < last_window_ || !gaps(1).empty()) return false;
  std::vector<Role> needed = solvers();
  needed.push_back(Role::Coupler);
  return std::all_of(needed.begin(), needed.end(), [this](Role role) {
    const auto found = senders_.find(role);
    return found != senders_.end() && found->second.is_done;
  });
}

}  // namespace crosswalk::recording
