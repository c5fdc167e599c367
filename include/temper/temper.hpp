// All headers for a first program: read a mesh, improve it, look at it, write it.
//
//     auto file = temper::io::read("coast.msh");
//     auto loaded = temper::io::make_mesh(*file);
//     auto report = temper::optimize(loaded->mesh, {.scheme = temper::Scheme::cell}, {.solvers = temper::solvers()});
//     temper::io::update(*file, *loaded, loaded->mesh, report->vertices);
//     temper::io::write("tempered.vtu", *file);
//
// Link temper::io and temper::solvers.
#pragma once

#include "temper/io.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/solvers.hpp"
