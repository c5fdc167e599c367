// OptimizeOptions from and to a dictionary of Python's, by one list of its fields.
#pragma once

#include "convert.hpp"
#include "temper/optimize.hpp"

TEMPER_PYTHON_NAMES(temper::Solver, "newton", "golden", "alternating");
TEMPER_PYTHON_NAMES(temper::FlipLimit, "unlimited", "before", "at", "after");
TEMPER_PYTHON_NAMES(temper::EnergyKind, "F", "T", "dT", "BH", "BHs", "BP");
TEMPER_PYTHON_NAMES(temper::Star, "0", "1", "2", "all");
TEMPER_PYTHON_NAMES(temper::Flips, "immediate", "deferred", "none");
TEMPER_PYTHON_NAMES(temper::Unknowns, "positions_and_weights", "positions", "weights");
TEMPER_PYTHON_NAMES(temper::InterfaceVertices, "fixed", "sliding");
TEMPER_PYTHON_NAMES(temper::BoundaryVertices, "keep", "slide", "split");
TEMPER_PYTHON_NAMES(temper::WeightUpdates, "immediate", "deferred");
TEMPER_PYTHON_NAMES(temper::Removal, "none", "patch");
TEMPER_PYTHON_NAMES(temper::RemovalMeasure, "sum", "mean", "excess");
TEMPER_PYTHON_NAMES(temper::Inversion, "refuse", "allow");
TEMPER_PYTHON_NAMES(temper::Repair, "none", "moves", "vertices");
TEMPER_PYTHON_NAMES(temper::SweepOrder, "hilbert", "input", "reverse", "random");
TEMPER_PYTHON_NAMES(temper::StoppingRule, "relative", "paper");
TEMPER_PYTHON_NAMES(temper::Objective, "energy", "accuracy");
TEMPER_PYTHON_NAMES(temper::HiddenPolicy, "undo", "remove", "keep");

namespace temper::python {

/// Every option of the accuracy objective.
template <class Options, class Visit>
void each_accuracy_option(Options& o, const Visit& visit) {
  visit("offset_weight", o.offset_weight);
  visit("boundary_offset_weight", o.boundary_offset_weight);
  visit("margin", o.margin);
  visit("barrier", o.barrier);
  visit("sweeps", o.sweeps);
  visit("tolerance", o.tolerance);
}

/// Every option that is a plain value, by its C++ name.
template <class Options, class Visit>
void each_option(Options& o, const Visit& visit) {
  visit("objective", o.objective);
  visit("accuracy", o.accuracy);
  visit("energy", o.energy);
  visit("star", o.star);
  visit("gamma", o.paper.gamma);
  visit("h0", o.paper.h0);
  visit("boundary_treatment", o.paper.boundary_treatment);
  visit("solver", o.paper.solver);
  visit("unknowns", o.unknowns);
  visit("weights_from", o.paper.weights_from);
  visit("weight_updates", o.paper.weight_updates);
  visit("flips", o.flips);
  visit("inner", o.paper.inner);
  visit("outer", o.paper.outer);
  visit("flip_limit", o.paper.flip_limit);
  visit("overshoot", o.paper.overshoot);
  visit("relaxation", o.paper.relaxation);
  visit("newton_passes", o.paper.newton_passes);
  visit("interfaces", o.interfaces);
  visit("boundary", o.boundary);
  visit("boundary_ratio", o.boundary_ratio);
  visit("inversion", o.paper.inversion);
  visit("hidden", o.paper.hidden);
  visit("order", o.paper.order);
  visit("anchor", o.paper.anchor);
  visit("collapse_from", o.paper.collapse_from);
  visit("collapse_energy", o.paper.collapse_energy);
  visit("collapse_ratio", o.paper.collapse_ratio);
  visit("removal", o.paper.removal);
  visit("removal_measure", o.paper.removal_measure);
  visit("removal_margin", o.paper.removal_margin);
  visit("removal_from", o.paper.removal_from);
  visit("repair", o.repair);
  visit("repair_trials", o.repair_trials);
  visit("max_sweeps", o.max_sweeps);
  visit("tolerance", o.paper.tolerance);
  visit("stopping", o.paper.stopping);
  visit("size_band", o.size_band);
  visit("time_limit", o.time_limit);
  visit("seed", o.paper.seed);
}

/// Those of the options that the dictionary names.
OptimizeOptions options_from(const py::dict& dict, OptimizeOptions options);
py::dict options_to_dict(const OptimizeOptions& options);
py::dict report_to_dict(const OptimizeReport& report);
py::dict record_to_dict(const SweepRecord& record);
py::dict size_report_to_dict(const SizeReport& report);

}  // namespace temper::python
