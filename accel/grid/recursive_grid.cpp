// Recursive grid, Jevans' adaptive 3-D grid (Arvo & Kirk §5.1, nonuniform subdivision)
// D. Jevans, B. Wyvill, "Adaptive voxel subdivision for ray tracing", 1989.
//
// Idea       A grid over the scene, and in every cell with too many objects a grid of its own, as fine as those objects
//            ask for, and so on. A ray walks each of them with the three-dimensional digital differential analyser: it
//            comes quickly through open space and finds small cells where the scene is crowded. The tree is shallow
//            where an octree, with its eight cells a level, is deep.
// Parameters resolution      heterogeneous: cubic cells
//            density         cells per object of the outermost grid; 3, fewer than a uniform grid's 5, for crowded places get
//                            grids of their own
//            nested_density  the same for grids within cells; 1
//            max_objects     more in a cell make a grid; 16, since to enter a nested grid costs a ray as much as some tests
//            max_depth       levels of grids; 4, as Jevans (1990, §2) says of trees that do
//            mailbox         auto: where some object is listed twice
// Cost       steps at each level in proportion to the cube root of the objects there, and a descent for each crowded
//            cell on the way.
// Weak       the granularity of each level follows from a number of objects alone, whatever a ray pays for them; objects
//            much larger than the cells they crowd are listed again and again (Jevans 1990, §2 and §7.1).

#include <numeric>

#include "accel/core/define_technique.h"
#include "accel/parts/grid_nesting.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

struct RecursiveGridConfig {
  NestingRules nesting;
  MailboxUse mailbox = MailboxUse::automatic;
};

template <class Real>
class RecursiveGrid {
 public:
  using Scalar = Real;
  using Config = RecursiveGridConfig;
  using Scratch = NestedScratch;

  static TechniqueInfo info() {
    std::vector<Parameter> parameters = nesting_parameters({});
    parameters.push_back(mailbox_parameter());
    return {.id = "recursive_grid",
            .title = "Recursive grid (adaptive 3-D grid)",
            .family = "grid",
            .survey_section = "5.1",
            .paper = "Jevans & Wyvill 1989",
            .parameters = parameters,
            .events = kNestedGridEvents};
  }
  static Config configure(const Arguments& arguments) {
    return {.nesting = nesting_rules(arguments), .mailbox = mailbox_use(arguments)};
  }

  static RecursiveGrid build(const BuildInput<Real>& in, const Config& config) {
    RecursiveGrid technique;
    const std::uint32_t objects = in.geometry.size();
    if (objects == 0) return technique;

    // Divide the box of all objects, then each cell with too many.
    std::vector<std::uint32_t> all(objects);
    std::iota(all.begin(), all.end(), 0u);
    technique.grids_ = NestedGrids<Real>(objects);
    technique.root_ =
        GridNesting<Real>(in.geometry, config.nesting, technique.grids_).outermost(in.geometry.bounds(), all);

    technique.structure_ = technique.grids_.structure();
    if (wants_mailbox(config.mailbox, technique.structure_.references, objects))
      technique.mailboxes_ = objects;
    return technique;
  }

  /// A nested grid stands in one cell alone and needs no mailbox.
  Scratch scratch() const { return {Mailbox(mailboxes_), Mailbox()}; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    visit_objects_of_cells(cells(scratch), ray, scratch.objects, count, leaf);
  }

  NestedOnRay<Real> cells(Scratch& scratch) const { return {grids_, root_, scratch.grids}; }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    grids_.for_each_cell(visit);
  }

  StructureStats structure() const { return structure_; }

 private:
  NestedGrids<Real> grids_;
  std::uint32_t root_ = 0;
  StructureStats structure_;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(recursive_grid, RecursiveGrid)

}  // namespace rayshoot
