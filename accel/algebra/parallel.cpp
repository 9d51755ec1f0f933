// Parallel composition (Revelles & Ureña 1999, §5.2)
//
// Idea       The candidates of A1||A2 are those that both A1 and A2 have (equation 19). To leave them in order without
//            making either set whole, the ray is followed in stretches: up to a horizon the candidates of A2 are marked,
//            and those of A1 are handed on where they are marked. A hit before the horizon ends it; otherwise the horizon
//            is set twice as far.
// Parameters none.
// Cost       That of both, and of the first stretches once more; M is at most the lesser of the two (strict optimizers).
// Weak       where a test of an object costs no more than finding out that it can be left out.

#include "accel/algebra/parallel.h"

#include "accel/algebra/numbers.h"

namespace rayshoot {

namespace {

template <class Real>
class Parallel final : public Optimizer<Real> {
 public:
  Parallel(const OptimizerInput<Real>& input, const BuildPart<Real>& first, const BuildPart<Real>& second)
      : first_(first(input)),
        second_(second(input)),
        box_(input.geometry.bounds()),
        objects_(input.geometry.size()),
        number_(input) {}

  std::unique_ptr<EngineScratch> scratch() const override { return std::make_unique<Scratch>(*this); }

  bool visit(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
             CandidateVisitor<Real>& visitor) const override {
    auto& own = static_cast<Scratch&>(scratch);
    own.marked.begin_ray(), own.handed_on.begin_ray();
    const auto mark = [&](std::uint32_t object, Real&) {
      own.marked.first_visit(number_(object));
      return false;
    };
    const auto hand_on_marked = [&](std::uint32_t object, Real& reach) {
      const std::uint32_t number = number_(object);
      if (!own.marked.met(number) || !own.handed_on.first_visit(number)) return false;
      const bool end = visitor({&object, 1});
      reach = std::min(reach, visitor.reach());
      return end;
    };
    for (Stretches stretches(box_, ray);; stretches.go_on()) {
      // Mark what the second part finds up to the horizon.
      const Real horizon = std::min(stretches.horizon(), visitor.reach());
      UpTo marks(horizon, mark);
      second_->visit(ray, *own.second, count.below(first_->levels()), marks);
      // Hand on what the first part finds there as well.
      UpTo common(horizon, hand_on_marked);
      if (first_->visit(ray, *own.first, count, common)) return true;
      // A hit before the horizon, or the end of the ray, leaves nothing to be found.
      if (!(horizon < visitor.reach())) return false;
    }
  }

  StructureStats structure() const override {
    StructureStats stats = first_->structure();
    stats += second_->structure();
    stats.figures.clear();
    return stats;
  }
  std::size_t levels() const override { return first_->levels() + second_->levels(); }

 private:
  struct Scratch final : EngineScratch {
    explicit Scratch(const Parallel& composition)
        : first(composition.first_->scratch()),
          second(composition.second_->scratch()),
          marked(composition.objects_),
          handed_on(marked) {}

    std::unique_ptr<EngineScratch> first, second;
    /// Objects that the second part, and that both parts have found.
    Mailbox marked, handed_on;
  };

  /// Asks a part for its candidates up to the horizon.
  template <class Take>
  class UpTo final : public CandidateVisitor<Real> {
   public:
    UpTo(Real horizon, const Take& take) : CandidateVisitor<Real>(horizon), take_(take) {}
    bool operator()(std::span<const std::uint32_t> objects) override {
      return std::any_of(objects.begin(), objects.end(),
                         [&](std::uint32_t object) { return take_(object, this->reach_); });
    }

   private:
    const Take& take_;
  };

  /// Where the stretches of a ray end: an eighth of its way through the scene's bounds, then each time twice as far, and
  /// behind the bounds nowhere.
  class Stretches {
   public:
    Stretches(const Box<Real>& box, const Ray<Real>& ray) {
      const Interval<Real> inside = interval_inside(box, ray);
      begin_ = std::max(inside.enter, ray.t_min), end_ = inside.exit;
      way_ = (end_ - begin_) / 8;
    }
    Real horizon() const {
      const Real horizon = begin_ + way_;
      return horizon > begin_ && horizon < end_ ? horizon : std::numeric_limits<Real>::infinity();
    }
    void go_on() { way_ *= 2; }

   private:
    Real begin_, end_, way_;
  };

  std::unique_ptr<Optimizer<Real>> first_, second_;
  Box<Real> box_;
  std::uint32_t objects_;
  Numbers<Real> number_;
};

}  // namespace

template <class Real>
std::unique_ptr<Optimizer<Real>> parallel(const OptimizerInput<Real>& input, const BuildPart<Real>& first,
                                          const BuildPart<Real>& second) {
  return std::make_unique<Parallel<Real>>(input, first, second);
}

template std::unique_ptr<Optimizer<float>> parallel(const OptimizerInput<float>&, const BuildPart<float>&,
                                                    const BuildPart<float>&);
template std::unique_ptr<Optimizer<double>> parallel(const OptimizerInput<double>&, const BuildPart<double>&,
                                                     const BuildPart<double>&);

}  // namespace rayshoot
