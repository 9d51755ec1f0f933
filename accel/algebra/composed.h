#pragma once

#include <optional>

#include "accel/core/optimizer.h"

namespace rayshoot {

/// An optimizer, however it was composed, as what answers queries. For each level of a composition it counts the events
/// level_<L>_steps and level_<L>_candidates, the distinct candidates of that level; a technique counts its own events.
template <class Real>
class Composed {
 public:
  using Scalar = Real;
  struct Scratch {
    std::unique_ptr<EngineScratch> optimizer;
    Mailbox mailbox;
    /// Made when a query is counted first.
    std::optional<LevelWork> levels;
  };

  /// Of the `objects` of the scene that it was built over; `composed` says whether of levels.
  Composed(std::unique_ptr<Optimizer<Real>> optimizer, std::uint32_t objects, bool composed = true)
      : optimizer_(std::move(optimizer)),
        objects_(objects),
        composed_(composed),
        structure_(optimizer_->structure()),
        mailboxes_(wants_mailbox(MailboxUse::automatic, structure_.references, objects) ? objects : 0) {}

  static std::vector<std::string> events(std::size_t levels) {
    std::vector<std::string> names;
    for (std::size_t level = 0; level < std::min(levels, LevelWork::kMostLevels); ++level)
      for (const char* what : {"steps", "candidates"})
        names.push_back("level_" + std::to_string(level) + "_" + what);
    return names;
  }

  Scratch scratch() const { return {optimizer_->scratch(), Mailbox(mailboxes_), {}}; }
  StructureStats structure() const { return structure_; }

  /// Hand the optimizer's candidates to the leaf, each once.
  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    const bool once = scratch.mailbox.in_use();
    if (once) scratch.mailbox.begin_ray();
    struct Visitor final : CandidateVisitor<Real> {
      Visitor(L& leaf, Mailbox* mailbox, Counter count)
          : CandidateVisitor<Real>(leaf.reach()), leaf_(leaf), mailbox_(mailbox), count_(count) {}
      bool operator()(std::span<const std::uint32_t> objects) override {
        for (const std::uint32_t object : objects)
          if (mailbox_ && !mailbox_->first_visit(object))
            count_.mailbox_hit();
          else if (leaf_(object))
            return true;
        this->reach_ = leaf_.reach();
        return false;
      }

      L& leaf_;
      Mailbox* mailbox_;
      Counter count_;
    } visitor(leaf, once ? &scratch.mailbox : nullptr, count);
    visit_counted(ray, scratch, count, visitor);
  }

 private:
  void visit_counted(const Ray<Real>& ray, Scratch& scratch, NoCount, CandidateVisitor<Real>& visitor) const {
    optimizer_->visit(ray, *scratch.optimizer, LevelCount(), visitor);
  }

  void visit_counted(const Ray<Real>& ray, Scratch& scratch, Count count,
                     CandidateVisitor<Real>& visitor) const {
    if (!scratch.levels) scratch.levels.emplace(objects_);
    LevelWork& levels = *scratch.levels;
    levels.begin_ray();
    optimizer_->visit(ray, *scratch.optimizer, LevelCount(levels), visitor);
    // Count the work of all levels, and by level what tells them apart.
    for (std::size_t level = 0; level < LevelWork::kMostLevels; ++level) {
      const Work& work = levels.work(level);
      count.traversal(work);
      for (std::size_t kind = 0; !composed_ && kind < kMostEventKinds; ++kind)
        count.event(kind, work.events[kind]);
      if (!composed_) continue;
      count.event(2 * level, work.steps);
      count.event(2 * level + 1, work.distinct_objects);
    }
  }

  std::unique_ptr<Optimizer<Real>> optimizer_;
  std::uint32_t objects_;
  bool composed_;
  StructureStats structure_;
  std::uint32_t mailboxes_;
};

}  // namespace rayshoot
