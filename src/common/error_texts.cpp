// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"

#include <iterator>

namespace pcl_uvol::detail {

namespace {

const MessageText error_rows[] = {
    // common
    {"unknown_message", "There is no message with the code '{code}'."},
    {"field_of_names",
     "The field '{field}' contains names, but a field of numbers is required. Try: "
     "{-where} to select by name."},
    {"message_without_value", "The message '{message}' has no value '{value}'."},
    {"cloud_without_xyz",
     "The cloud requires one number each for x, y and z; it has {fields}."},
    {"cloud_beyond_numbers",
     "{points} points are more than PCL can number. Try: process them in pieces."},
    {"cloud_big_endian",
     "The cloud is big-endian, which is not supported. Try: swap its bytes first."},
    {"cloud_too_short",
     "The cloud has {bytes} bytes, too few for its {points} points."},
    {"cloud_incomplete", "The cloud has too few bytes for its {points} points."},
    {"cloud_without_float_xyz",
     "The cloud requires float32 fields x, y, z; it has {fields}."},
    {"field_beyond_point",
     "The field {field} ends beyond the {bytes} bytes of a point of the cloud."},
    {"field_behind_point", "The field '{field}' ends beyond the bytes of its point."},
    {"records_beyond_numbers",
     "{points} points of {bytes} bytes are more than PCL can number."},
    {"stage_without_cloud", "{stage} has no input cloud. Try: call setInputCloud."},
    {"empty_cloud", "The input cloud of {stage} is empty."},
    {"no_indices", "The list of point indices of {stage} is empty."},
    {"index_beyond_cloud",
     "The index {index} given to {stage} is too large: the cloud has {points} points."},
    {"coordinates_beyond_float",
     "The coordinates are larger than float can hold (3.4e38). Try: scale the "
     "coordinates down."},
    {"coordinates_not_in_threes",
     "There are {coordinates} coordinates, but each point requires three."},
    {"coordinates_of_other_points",
     "There are coordinates of {given} points, but the cloud has {points} points."},
    {"field_of_wrong_length",
     "The field '{field}' has {values} values for {points} points."},
    {"field_exists", "The field '{field}' exists already. Try: rename it."},
    {"field_is_coordinate", "The field '{field}' is a coordinate."},
    {"unknown_datatype", "A field has the unknown type {type}."},
    {"unknown_field",
     "There is no field '{field}'; the fields are {fields}.{has_coordinates_only| Try: "
     "{-cells} if the file has cell data.|}"},
    {"no_coordinate_field",
     "There is no scalar field {axis}; the fields are {fields}."},
    {"no_scalar_field", "There is no scalar field; the fields are {fields}."},
    {"several_scalar_fields", "Name one of the scalar fields: {fields}."},
    {"field_of_components",
     "The field '{field}' has {components} components; one number per sample is "
     "required. Try: {field}[0] to {field}[{last}], or |{field}| for the length."},
    {"component_not_number",
     "The component in '{field}' is not a non-negative integer, for example vel[1]."},
    {"component_too_large",
     "The component in '{field}' is too large: it must be 0 to {last}."},
    {"strike_not_finite",
     "The strike of the axes is {strike} degrees: it must be finite."},
    {"dip_out_of_range", "The dip of the axes is {dip} degrees: it must be 0 to 90."},
    {"plunge_too_steep",
     "The plunge of the axes is {plunge} degrees: it must not be steeper than the dip "
     "of the plane, {dip}."},
    {"scale_map_not_finite", "The nine numbers of the scale must be finite."},
    {"scale_map_flat",
     "The nine numbers of the scale are degenerate: the three rows are coplanar."},
    {"parameters_not_json", "The parameters are not valid JSON."},
    {"wrong_parameter", "The parameter {name} is {value}: it must be {expected}."},
    {"unknown_parameter",
     "There is no parameter {name}{has_similar| (did you mean '{similar}'?)|}; the "
     "parameters are {names}."},
    {"unknown_simd_level",
     "The environment variable PCL_UVOL_SIMD is '{level}': it must be baseline, avx2 "
     "or avx512."},
    {"not_enough_memory",
     "{what} needs {needed} of memory, and only {available} are available."},
    {"memory_of_other_processes",
     "{processes} of the other processes have too little memory for their samples. "
     "Try: "
     "more processes or machines."},

    // neighbors
    {"too_many_candidates",
     "The Voronoi grid has too many candidate neighbours: {candidates} ({per_sample} "
     "per sample, at most {most}), because samples crowd in few cells. Try: more "
     "cells, or the kd-tree."},
    {"grid_box_not_ordered",
     "The corners of a grid's box must be finite, the lower corner first."},
    {"grid_cells_out_of_range",
     "A grid cannot have {cells} cells along an axis: 1 to {most} are allowed."},
    {"grid_beyond_numbers", "{grid} exceeds the 4 billion cells that can be numbered."},
    {"voronoi_cells_out_of_range",
     "A Voronoi grid must have 1 to {most} cells along each axis."},
    {"voronoi_grid_not_allowed",
     "A grid must have 1 to {most} cells along each axis, with finite positive sides."},
    {"voronoi_grid_without_point",
     "A discrete Voronoi diagram requires a point with finite coordinates."},
    {"margin_of_oblong_cells",
     "A margin requires cubic cells. Try: give one number of cells."},
    {"input_without_point", "The input has no point with finite coordinates."},
    {"scale_beyond_float",
     "The scale {x}, {y}, {z} moves coordinates out of the range of float. Try: "
     "factors that differ less, or smaller coordinates."},
    {"no_finite_value", "No sample has a finite value of {field}."},
    {"no_usable_sample",
     "The cloud has no usable sample: all {samples} given have a non-finite "
     "coordinate."},
    {"no_sample_for_scale",
     "No sample has finite coordinates, so the scale cannot be estimated."},
    {"exact_neighbors_in_pieces",
     "Exact natural neighbours require all samples in one piece."},
    {"periodic_side_not_allowed",
     "The side {side} of the periodic box is not allowed: it must be positive, or 0 "
     "for an axis that is not periodic."},
    {"no_nearest_neighbors",
     "The number of nearest neighbours is 0: it must be at least 1."},
    {"neighbors_not_finite",
     "Sample {sample} has only {found} of {needed} neighbours at a finite distance. "
     "Try: scale the coordinates."},
    {"neighbor_search_null", "The search method for nearest neighbours is null."},

    // interpolation
    {"bad_smoothing_length", "A smoothing length must be a number from 0."},
    {"single_point_box",
     "The box of the grid is a single point. Try: another box ({-box})."},
    {"no_finite_sample", "No sample has a finite position."},
    {"too_many_blocks",
     "The box of the samples contains more than 16,777,216 blocks. Try: larger "
     "blocks."},
    {"block_sides_not_positive", "The sides of blocks must be finite and positive."},
    {"no_block_estimated",
     "No block estimate is better than the mean of all samples: all blocks are outside "
     "the data, or values are not correlated at the sample distances."},
    {"folds_not_allowed",
     "The number of folds is {folds}: it must be 2 to {most}, the number of {things}."},
    {"single_fold",
     "All samples are in one fold. Try: another division of the samples."},
    {"values_of_other_points",
     "There are {values} interpolated values, but {points} points. Try: interpolate at "
     "these points."},
    {"interpolation_number", "The {number} is {value}: it must be {allowed}."},
    {"no_model_has_values",
     "No model has values at the held-out samples. Try: name the model to use."},
    {"no_field_for_value_outside",
     "{-outside-value} requires a field of single numbers, but '{field}' is not one; "
     "the fields are {fields}."},
    {"value_outside_not_held",
     "The field '{field}' cannot represent the value {value:17} of {-outside-value}."},
    {"few_samples_for_value_outside",
     "{-outside-value} requires more than {samples} distinct samples."},
    {"unordered_box",
     "The box of a grid must be finite, with its second corner above the first."},
    {"plane_misses_data",
     "The plane misses the box of the data, from ({low_x}, {low_y}, {low_z}) to "
     "({high_x}, {high_y}, {high_z})."},
    {"no_finite_point", "There is no point with finite x, y, z."},
    {"line_without_ends", "A line requires two different ends and at least 2 points."},
    {"few_points_of_grid", "A grid requires at least 2 points along its longest side."},
    {"no_points_along_axis", "A grid requires at least one point along each axis."},
    {"flat_box",
     "The box of the grid has no extent along an axis, but {points} points are "
     "requested there: only 1 is possible."},
    {"plane_without_normal", "The normal of a plane must be finite and non-zero."},
    {"few_points_of_slice", "A slice requires at least 2 points along each side."},
    {"plane_touches_data", "The plane touches the data in only one point."},
    {"few_samples_for_derivatives",
     "Derivatives require at least four samples with values; there are {samples}."},
    {"few_places_for_derivatives",
     "Derivatives require samples at four positions or more; there are {places}."},

    // expressions
    {"derivatives_of_blocks",
     "The derivatives in '{field}' are not available for points that are read block by "
     "block. Try: no {-max-memory}."},
    {"no_derivatives", "The derivatives in '{field}' are not available {reason}."},
    {"derivatives_without_coordinates",
     "The derivatives in '{field}' require coordinates, but the points have none."},
    {"no_comparison",
     "'{where}' is not a comparison: use one of =, !=, <, <=, >, >= between two fields "
     "or numbers, for example T>=4."},
    {"unknown_lone_field",
     "There is no field '{field}'{has_similar| (did you mean '{similar}'?)|}; the "
     "fields are {fields}.{has_cell_fields| Try: {-cells} for the cell data "
     "{cell_fields}.|}"},
    {"unknown_operand",
     "There is no field '{field}'{has_similar| (did you mean '{similar}'?)|}; the "
     "fields are {fields}.{has_cell_fields| Try: {-cells} for the cell data "
     "{cell_fields}.|}\n{marked_lines}"},
    {"unknown_function",
     "There is no function '{function}'; {has_similar|did you mean {similar}?|the "
     "functions are {functions}.}\n{marked_lines}"},
    {"unknown_name",
     "The field '{field}' has no name '{name}'{has_similar|; did you mean "
     "'{similar}'?|.}\n{marked_lines}"},
    {"names_not_compared",
     "'{field}' contains names, which can only be compared by = and !=, for example "
     "{operand}=\"{name}\".\n{marked_lines}"},
    {"several_components",
     "'{name}' has {components} components: use |{operand}| for their length, or "
     "{operand}[0] to {operand}[{last}] for one component.\n{marked_lines}"},
    {"expression_too_long",
     "The expression has {characters} characters: at most {most} are "
     "allowed.\n{marked_lines}"},
    {"expression_without_field",
     "The expression does not name a field.\n{marked_lines}"},
    {"expression_too_deep",
     "Functions and lengths are nested more than {most} deep.\n{marked_lines}"},
    {"parenthesis_not_closed", "A parenthesis is not closed.\n{marked_lines}"},
    {"no_parenthesis_open", "No parenthesis is open.\n{marked_lines}"},
    {"bar_not_closed", "A bar is not closed.\n{marked_lines}"},
    {"quotation_not_closed", "A quotation mark is not closed.\n{marked_lines}"},
    {"number_too_large", "The number is too large.\n{marked_lines}"},
    {"operand_missing", "A field or a number is missing.\n{marked_lines}"},
    {"operand_missing_at_end",
     "A field or a number is missing at the end.\n{marked_lines}"},
    {"name_missing", "A name is missing.\n{marked_lines}"},
    {"operator_missing", "An operator is missing.\n{marked_lines}"},
    {"single_ampersand",
     "A single & is not an operator: use && to join conditions.\n{marked_lines}"},
    {"chained_comparisons",
     "Comparisons cannot be chained: join them with &&, for example 1<T && "
     "T<2.\n{marked_lines}"},
    {"no_field_derived", "There is no field to derive.\n{marked_lines}"},
    {"argument_not_one_number",
     "{function} requires one number per point, for example "
     "{function}(rho).\n{marked_lines}"},
    {"argument_not_vector",
     "{function} requires a field of three components or three fields, for example "
     "{function}(vel) or {function}(vx,vy,vz).\n{marked_lines}"},
    {"component_not_in_brackets",
     "A component is a non-negative integer in brackets, for example "
     "vel[1].\n{marked_lines}"},
    {"operand_component_too_large",
     "The component is too large: it must be 0 to {last}.\n{marked_lines}"},
    {"misplaced_comma",
     "A comma is outside the arguments of a function.\n{marked_lines}"},
    {"too_many_arguments", "A function has too many arguments.\n{marked_lines}"},
    {"too_few_arguments", "A function has too few arguments.\n{marked_lines}"},
    {"misplaced_condition", "The signs ? and : do not match.\n{marked_lines}"},
    {"program_too_long", "The expression is too long.\n{marked_lines}"},
    {"not_computable", "The expression cannot be computed.\n{marked_lines}"},

    // isosurface
    {"extraction_without_isovalue",
     "IsosurfaceExtraction has no isovalue. Try: call setIsoValue or setIsoValues."},
    {"isovalue_not_finite", "The isovalue {isovalue} is not finite."},
    {"repeated_isovalue", "The isovalue {isovalue} is given more than once."},
    {"scale_not_positive",
     "The scale {scale} is not allowed: it must be finite and positive."},
    {"edge_ends_beyond_numbers",
     "The isopoints are between {points} points, more than one process can number."},
    {"isopoints_of_other_edges",
     "There are {isopoints} isopoints, but {edges} edges: each isopoint requires one "
     "edge."},
    {"edges_of_other_isopoints",
     "interpolateFields requires one edge per isopoint, but got {edges} edges."},
    {"edge_outside_samples",
     "An edge refers to a sample that does not exist: interpolateFields requires the "
     "cloud that the isopoints were extracted from."},

    // mesh
    {"edge_length_not_allowed",
     "The edge length {length} is not allowed: it must be finite and not negative."},
    {"mesh_of_linear_interpolation",
     "A mesh cannot be combined with {-interpolation linear}: its topology would not "
     "be "
     "that of the field."},
    {"mesh_of_voronoi_neighbors",
     "A mesh cannot be combined with {-neighbors voronoi} or {-neighbors exact}: it "
     "uses the cells of the kd-tree."},
    {"contrary_triangles",
     "Triangles contradict each other about the outside at {edges} edges, so the "
     "surface has no volume. Try: repair the mesh."},
    {"triangle_beyond_vertices",
     "A triangle refers to vertex {vertex}, but there are {vertices} vertices."},
    {"vertex_not_finite", "Vertex {vertex} of the surface is not finite."},
    {"surface_points_without_normal",
     "No point of the surface has a normal: normals are required to determine the "
     "surface and its outside."},
    {"surface_without_normals",
     "The surface has neither triangles nor normals. Try: estimate normals first."},
    {"surface_points_too_few",
     "The points of the surface are too few, or too far apart, to measure its area."},
    {"surface_without_points",
     "The distance to a surface without points is undefined."},
    {"too_many_intersections",
     "More than {most} pairs of triangles of the surface intersect: many of them "
     "coincide. Try: repair the mesh."},
    {"measures_without_surface",
     "SurfaceMeasures has no surface. Try: call setInputSurface."},
    {"inside_without_triangles",
     "Samples inside can only be found for a surface with triangles."},

    // levelset
    {"initial_sphere_not_allowed",
     "The initial sphere of the level set must have a finite centre and a positive "
     "radius."},
    {"initial_box_not_allowed",
     "The initial box of the level set must have finite corners, the first below the "
     "second along every axis."},
    {"initial_box_turned",
     "An initial box cannot be combined with a rotation: its sides are parallel to x, "
     "y and z."},
    {"initial_plane_not_allowed",
     "The initial plane of the level set must have a finite point and a non-zero "
     "normal."},
    {"initial_field_not_finite",
     "The initial field {field} of the level set is not finite everywhere."},
    {"phi_of_other_points",
     "There are {values} values of phi, but {points} points: each point requires one "
     "value."},
    {"isovalue_beyond_values",
     "The isovalue {isovalue} does not separate the values of {field}, which are in "
     "[{low}, {high}]: there is no surface to evolve."},
    {"level_set_without_isovalue",
     "LevelSetEvolution has no finite isovalue. Try: call setIsoValue."},
    {"mu_out_of_range", "The weight mu is {mu}: it must be in [0, 1]."},
    {"level_set_scale_not_positive",
     "The scale is {scale}: it must be finite and positive."},
    {"no_level_set_steps", "The number of steps is 0: it must be at least 1."},
    {"level_set_tolerance_not_positive",
     "The tolerance is {tolerance}: it must be positive."},
    {"narrow_band",
     "The width of the band is {width}: it must be at least 3 spacings, or 0 for no "
     "band."},
    {"few_samples_for_stencil",
     "There are {samples} distinct samples, too few for a stencil of {neighbors} "
     "neighbours: at least one more than that is required."},
    {"only_outliers_beyond_isovalue",
     "Only outliers are beyond the isovalue {isovalue}, samples unlike all their "
     "neighbours: there is no surface to evolve. Try: no smoothing."},
    {"surface_samples_without_extent", "The samples at the surface have no extent."},
    {"start_without_zero_level",
     "The initial function of the level set has no zero level among the samples."},
    {"no_slope_at_isovalue",
     "The values near the isovalue {isovalue} do not change between samples, but a "
     "level set requires their slope. Try: extract the isosurface without smoothing."},
    {"level_set_diverged", "The level set diverged in step {step}. Try: {advice}."},

    // surface
    {"cloud_without_finite_point", "The cloud has no point with finite coordinates."},
    {"cloud_without_normal",
     "No point of the cloud has a normal, and no normal can be estimated."},
    {"splat_delta_not_positive",
     "The error bound delta of splats is {delta}: it must be positive."},
    {"splat_lambda_out_of_range",
     "The coverage factor lambda of splats is {lambda}: it must be in [0, 1]."},
    {"splats_without_extent",
     "All points of the cloud are at one position, so the error bound cannot be "
     "derived from the extent. Try: give it as a length."},
    {"splat_delta_beside_coordinates",
     "The error bound delta of splats, or the extent of the cloud, does not suit the "
     "coordinates: it must be 1e-12 to 1e15 times as large."},
    {"few_neighbors_for_normals",
     "The number of neighbours for normals is {neighbors}: it must be at least 2."},
    {"normals_scale_not_positive",
     "The scale of a normal estimation must be finite and positive along every axis."},

    // multivariate
    {"no_attributes",
     "No attributes are named. Name one or more of the fields {fields}."},
    {"same_attributes",
     "The attributes '{attribute}' and '{other}' are the same: each attribute can be "
     "given once."},
    {"no_complete_point",
     "None of the {points} points has a finite value of every attribute."},
    {"only_constant_attributes",
     "All attributes are the same at all points, so points cannot be distinguished."},
    {"attributes_of_empty_cloud", "The cloud of the attributes is empty."},
    {"vertex_without_region",
     "A triangle of the surface refers to vertex {vertex}, but there are {regions} "
     "regions."},
    {"no_probabilities",
     "The field {field} has values outside [0, 1], so they are not probabilities."},
    {"labels_of_other_points", "There are {labels} labels, but {points} points."},
    {"empty_attribute_table",
     "The table of a projection has {rows} rows and {attributes} attributes: at least "
     "one of each is required."},
    {"unfitting_attribute_table",
     "The attribute table has {values} values, but {rows} rows of {attributes} "
     "attributes: one value of each attribute per row is required."},
    {"unfitting_cluster_labels",
     "There are {labels} cluster labels, but {rows} rows of attributes: one label per "
     "row is required."},
    {"too_many_core_neighbors",
     "The number of neighbours of core distances is {neighbors}: it must be 0 to "
     "1000."},
    {"cluster_of_one_point",
     "The smallest cluster cannot have 1 point: it must have at least 2, or 0 for the "
     "default."},
    {"cut_distance_not_allowed",
     "The distance at which clusters are cut is {distance}: it must be positive, or 0 "
     "for no cut."},
    {"no_points_to_cluster", "There are no points to cluster."},
    {"unfitting_membership",
     "There are {values} membership values and {lengths} smoothing lengths, but "
     "{particles} particles: each particle requires one of each."},
    {"membership_out_of_range",
     "The membership of particle {particle} is {value}: it must be in [0, 1]."},
    {"no_such_cluster", "No point is in cluster {cluster}; the labels are: {labels}."},
    {"distance_to_empty_mesh", "A mesh without vertices has no distance field."},
    {"spanning_tree_without_rows",
     "A spanning tree requires rows of at least one number: {values} values do not "
     "form rows of {columns}."},
    {"spanning_tree_too_large",
     "A spanning tree cannot have {points} points: at most 2^31 - 1 are allowed."},
    {"spanning_tree_not_finite",
     "A spanning tree requires finite values. Try: exclude the other points."},
    {"regularization_not_allowed",
     "The regularization of Fisher ratios is {regularization}: it must be in (0, 1]."},
    {"projection_of_other_attributes",
     "The attributes of the projection differ from the attributes of the table."},

    // pipeline
    {"no_sample_with_value", "No sample has a position and a finite value of {field}."},
    {"not_out_of_core",
     "Level sets, automatic or rotated scales, cross-validation, meshes, filled gaps, "
     "values outside, periodic boxes and Voronoi neighbours require all samples in "
     "memory."},
    {"no_field_for_gaps",
     "Gaps cannot be filled in the field '{field}': a field of single numbers is "
     "required. The fields are {fields}."},
    {"pipeline_without_input", "IsosurfacePipeline has no input. Try: call setInput."},
    {"linear_with_fitted_normals",
     "{-normals fit} cannot be combined with {-interpolation linear}, which makes no "
     "fits."},
    {"hold_out_of_one_fold",
     "Cross-validation with 1 fold leaves no samples. Try: at least 2 folds."},
    {"few_normal_neighbors",
     "The number of neighbours for normals is {neighbors}: it must be at least 2."},
    {"largest_error_not_allowed",
     "The largest error is {error}: it must be finite and not negative."},
    {"two_largest_errors",
     "The largest error can be a length or automatic, but not both."},
    {"turned_periodic_box",
     "{-periodic} cannot be combined with a rotation: the sides of the box are "
     "parallel to x, y and z."},
    {"hold_out_in_periodic_box",
     "{-validate} cannot be combined with {-periodic}: periodic images of the held-out "
     "samples would reveal their values."},
    {"gaps_in_periodic_box",
     "{-fill-gaps} cannot be combined with {-periodic}: samples predicted by kriging "
     "would have no images."},
    {"value_outside_of_periodic_box",
     "{-outside-value} cannot be combined with {-periodic}: a periodic box has no "
     "outside."},
    {"value_outside_not_finite", "{-outside-value} is {value}: it must be finite."},
    {"gaps_beside_value_outside",
     "{-fill-gaps} cannot be combined with {-outside-value}: kriging would predict the "
     "step to that value."},
    {"nothing_to_weld",
     "Only the mesh of a periodic box can be welded across the faces."},
    {"mesh_without_points",
     "A mesh cannot be combined with {-max-error} or {-drop-bridged}: it keeps all "
     "vertices."},
    {"mesh_with_pca_normals",
     "A mesh cannot be combined with {-normals pca}: its vertices have the normals of "
     "the fits."},
    {"distributed_scale",
     "An automatic scale is not available for distributed samples, because no process "
     "has all of them. Try: three factors."},
    {"distributed_rotation",
     "A rotated scale is not available for samples that are distributed to several "
     "processes."},
    {"distributed_mesh",
     "A mesh is not available for samples of several processes: cells would have to be "
     "joined across process borders."},
    {"distributed_level_set",
     "A level set is not available for samples of several processes."},
    {"distributed_gaps",
     "Gaps cannot be filled in samples of several processes, because no process has "
     "all samples."},
    {"distributed_value_outside",
     "{-outside-value} is not available for samples of several processes, because no "
     "process knows where the samples end."},
    {"distributed_hold_out",
     "Cross-validation is not available for samples of several processes."},
    {"distributed_normals",
     "Isopoints of several processes have normals from fits, or else from edges; other "
     "normals are not available."},
    {"distributed_without_input",
     "DistributedIsosurfacePipeline has no input. Try: call setInput."},

    // render
    {"cloud_without_usable_splats", "no splat of '{cloud}' is usable."},
    {"cloud_without_extent",
     "all points of '{cloud}' are at one position, which cannot be fitted to a size."},
    {"splat_beyond_float",
     "a splat of '{cloud}' becomes larger or smaller than float can hold, or is beyond "
     "1e18."},
    {"material_beyond_one",
     "Reflectivity and transparency are {reflectivity} and {transparency}: both must "
     "be non-negative, and their sum at most 1."},
    {"bad_refractive_index", "The refractive index is {index}: it must be positive."},
    {"object_without_splats", "An object of splats has no splats."},
    {"colors_unlike_splats",
     "An object of {splats} splats has {colors} colours: each splat requires one "
     "colour."},
    {"rims_unlike_splats",
     "An object of {splats} splats has {rims} rims: each splat requires one rim."},
    {"object_with_bad_splat",
     "An object has a splat that is not finite, has no normal or radius, or is farther "
     "away than 1e18."},
    {"scene_without_objects", "The scene has no objects."},
    {"bad_sphere", "A sphere must have a finite centre and a positive radius."},
    {"bad_plane",
     "A plane must have a finite point, a non-zero normal and squares that are not "
     "negative."},
    {"bad_occlusion_distance", "The distance of occlusion must not be negative."},
    {"ray_tracer_without_scene", "RayTracer has no scene. Try: call setScene."},
    {"stretched_splats",
     "Splats cannot be stretched. Try: draw the points that the splats were made of."},
    {"camera_up_of_zero",
     "The upward direction of the camera is 0,0,0, which is not a direction."},
    {"camera_without_sight",
     "A camera requires two different finite positions: its own and the point that it "
     "looks at."},
    {"camera_up_along_sight",
     "The upward direction of a camera must be non-zero and not parallel to its line "
     "of sight."},
    {"bad_field_of_view",
     "The field of view is {degrees} degrees: it must be between 0 and 180."},
    {"unknown_view",
     "There is no view '{view}'. Try: front, back, left, right, top, bottom or iso."},
    {"render_setting_out_of_range",
     "The {name} is {number}: it must be {low} to {high}."},
    {"render_setting_not_positive", "The {name} is {number}: it must be positive."},
    {"bad_render_color",
     "The colour of {name} has the component {number}: components must be finite and "
     "not negative."},
    {"bad_material_factor",
     "A factor of the material is {factor}: factors must be finite and not negative."},
    {"light_from_nowhere",
     "A light requires a finite position or a non-zero direction."},
    {"bad_light_radius",
     "The radius of a light is {radius}: it must be finite and not negative."},
    {"bad_ambient_occlusion",
     "The strength of ambient occlusion is {strength}: it must be 0 to 1."},
    {"surface_prepared_of_others",
     "The surface was prepared from {prepared} points, but {drawn} points are to be "
     "drawn."},
    {"colors_unlike_points", "There are {colors} colours, but {points} points."},
    {"bad_opacity", "An opacity is {opacity}: opacities must be 0 to 1."},
    {"opacities_unlike_isovalues",
     "There are {opacities} opacities for {isovalues} isovalues: give one opacity, or "
     "one per isovalue, lowest isovalue first."},
    {"planes_with_supersampling",
     "Depth, normal and id cannot be combined with supersampling, because these values "
     "cannot be averaged."},
    {"planes_with_opacities",
     "Depth, normal and id cannot be combined with opacities, because transparent "
     "surfaces have no such values."},
    {"bad_image_size",
     "The image size {width} x {height} is not allowed: both numbers must be 1 to "
     "{most}."},
    {"unknown_color_map",
     "There is no colour map '{map}'. The maps are {maps}; add _r to a name to reverse "
     "it."},
    {"bad_color_range",
     "A colour range must be two finite numbers, the lower number first."},
    {"bad_mapped_color_range",
     "A colour range must be two finite numbers, the lower number first, and both "
     "positive for a logarithmic scale."},
    {"cloud_without_colors",
     "The cloud has no colours (rgb, rgba, or red, green and blue of one byte each); "
     "its fields are {fields}."},
    {"color_field_without_numbers", "None of the values of {field} is a number."},
    {"color_field_without_logarithms",
     "No value of {field} is positive, so there are no logarithms."},

    // vtk
    {"unfitting_grid_values",
     "A grid of {cells} cells requires one value per cell, but there are {values} "
     "values."},
    {"no_opengl_window", "Image-space rendering requires an OpenGL window of VTK."},
    {"uneven_camera",
     "Image-space rendering requires a camera and a cloud with the same scale along "
     "all axes. Try: remove other scales, shears and reflections."},
    {"unknown_projection",
     "Image-space rendering requires a perspective or parallel projection."},
    {"no_opengl_camera", "Image-space rendering requires VTK's OpenGL camera."},
    {"stretched_pixels",
     "Image-space rendering requires square pixels. Try: remove the pixel aspect of "
     "the renderer."},
    {"cluster_distance_not_allowed",
     "The distance of a surface from a cluster must be positive, or 0 for the distance "
     "of the spanning tree."},
    {"cluster_at_one_place",
     "All points of the cluster are at one position, so the distance is not defined. "
     "Try: give a distance."},
    {"no_hull",
     "The cluster has no hull: fewer than three of its points are on a surface around "
     "it.{has_outlier| Try: exclude point {point} ({ratio} median distances from the "
     "centre).|}"},
    {"cluster_too_large",
     "The surface around the cluster would be larger than float can hold (3.4e38). "
     "Try: scale the coordinates down."},
    {"cluster_without_positions", "The cluster has no point with finite coordinates."},
    {"few_points_for_hull",
     "A hull requires at least three points, but the cluster has {points}."},
    {"small_cluster_distance",
     "The distance {distance} is too small for grid cells of {cell}. Try: a finer grid "
     "or a larger distance."},

    // filters
    {"no_vtk_data", "There are no VTK data to convert to a cloud."},
    {"array_not_of_points",
     "The {array} is not point data, which is required. Try: vtkCellDataToPointData to "
     "convert cell data."},
    {"no_such_array",
     "There is no {array} of points. Try: SetInputArrayToProcess to choose one of the "
     "numeric arrays {arrays}."},
    {"array_of_other_points",
     "The {array} is a {type} of {tuples} tuples, but there are {points} points. "
     "Numeric arrays with one tuple per point are {arrays}."},
    {"no_such_component",
     "The {array} has {components} components, so there is no component {component} "
     "(zero-based)."},
    {"empty_source", "The source has no points to interpolate between."},

    // io
    {"columns_of_no_text",
     "Coordinate columns can only be chosen in text files, and '{path}' is not a text "
     "file."},
    {"particles_of_no_snapshot",
     "Particles can only be chosen in snapshots, and '{path}' is not a snapshot."},
    {"cells_of_no_grid",
     "Cells can only be read from VTK (except .vtkhdf), Exodus, EnSight and OpenFOAM "
     "files, but not from '{path}'."},
    {"resolution_not_allowed",
     "The resolution of an image is {resolution} dots per inch: it must be 1 to a "
     "million, or 0 for unspecified."},
    {"png_not_encoded", "libpng could not encode an image: {reason}."},
    {"image_without_pixels", "The image has no pixels."},
    {"empty_scene", "The scene '{path}' is empty: it has no cloud, sphere or plane."},
    {"vtk_library_not_loaded",
     "The library for VTK, HDF5, NetCDF and text in images could not be loaded: it is "
     "not next to libpcl_uvol_io.so, or memory is exhausted."},
    {"no_such_point", "There is no point {point}: the file has {points} points."},
    {"unsorted_points", "The points to read are not in ascending order."},
    {"too_many_points_for_process",
     "{points} points per process are too many: at most {most} are allowed. Try: more "
     "processes."},
    {"pieces_of_other_fields",
     "The pieces '{one}' and '{other}' have different fields: {fields} and "
     "{other_fields}. Try: write all pieces with the same arrays."},
    {"names_in_one_piece",
     "The field '{field}' contains names in the piece '{path}' and numbers in "
     "'{other}'. Try: join them to one file, where names may be numbers."},
    {"pieces_without_points", "None of the {pieces} pieces has points."},
    {"no_file_to_read", "No file to read is given."},

    // tools
    {"no_points", "{path} has no points."},
    {"no_points_where", "{path} has no points for which {where}."},
    {"no_box_in_file",
     "The file names no box. Try: its sides, as in {-periodic 100,100,100}."},
    {"splats_out_of_range",
     "None of the splats can be drawn: their coordinates are too large or too small. "
     "Try: other units."},
    {"no_coordinates_for", "The input has no coordinates for {-position}."},
    {"labels_not_integers",
     "The field {field} has values that are not integers: they are not labels."},
    {"no_variogram_of_constant",
     "The field {field} is the same at all samples: there is no variogram."},
    {"no_coordinates_to_sample",
     "The sampling of {path} is that of its coordinates, and it names none. Try: "
     "{-xyz}."},
    {"no_coordinates_to_draw",
     "The input has no coordinates to draw a surface in. Try: uvol_project."},
    {"no_surface_to_measure",
     "There is no isosurface to measure: {field} has all its values on one side of the "
     "isovalues."},
    {"unusable_mesh", "Cannot use '{path}': {reason}"},
    {"bad_chart_size", "An image has 1 to {most} pixels along each side."},
    {"labels_unlike_points", "There are {labels} labels for {points} points."},
    {"page_not_made", "Cannot make a page: {reason}."},
    {"data_elsewhere",
     "Cannot read '{path}', whose data are in another file: {reason}"},
    {"command_line", "{text}"},
    {"tool_not_started", "{path} could not be started: {reason}."},
    {"output_closed", "Standard output could not be written."},
    {"out_of_memory", "There is not enough memory."},
    {"out_of_threads", "There are not enough memory or threads for it."},

    // viewer
    {"all_values_missing", "All values of {field} are missing."},
    {"no_points_to_show", "There are no points to be shown."},
    {"all_values_equal",
     "All values of {field} are equal: there is no isosurface between them."},
    {"isovalue_beyond_range",
     "The isovalue {isovalue} is outside the range of {field}, {low} to {high}."},
    {"mesh_of_surface_points",
     "A mesh is made of samples, and these are points of a surface. Try: {-field} for "
     "the isosurfaces of samples."},
    {"no_points_at_isovalue",
     "There are no points at this isovalue of {field}. Try: another isovalue."},
    {"no_points_at_isovalues",
     "There are no points at the isovalues of {path} that were tried."},
    {"no_surface_to_draw", "There is no surface to draw."},
    {"no_surface_to_save", "There is no surface to save."},
    {"not_a_number", "{text} is not a number."},
    {"no_display",
     "There is no display (DISPLAY is not set). Try: uvol_render, which draws images "
     "without one."},
    {"display_not_opened",
     "The display {display} cannot be opened. Try: uvol_render, which draws images "
     "without one."},
    {"display_without_opengl",
     "The display {display} has no OpenGL. Try: uvol_render, which draws images "
     "without "
     "one."},

    // derivatives
    {"few_neighbors_for_scheme",
     "The number of neighbours is {neighbors}: it must be at least {least} for this "
     "scheme."},

    // gl
    {"gl_shader_not_compiled",
     "The driver cannot compile a shader. Try: the cpu backend. Log: {log}"},
    {"gl_shader_not_linked",
     "The driver cannot link a shader. Try: the cpu backend. Log: {log}"},
    {"gl_buffers_refused",
     "The driver cannot draw into the buffers of this image. Try: a smaller image, or "
     "the cpu backend."},
    {"gl_backend_without_context",
     "An OpenGL backend requires a context. Try: createHeadlessContext()."},
    {"gl_tiles_too_small", "The sides of tiles must be at least {least} pixels."},
    {"gl_layers_too_large",
     "Layers of {width} x {height} cells are too large for this OpenGL: at most {most} "
     "per side. Try: fewer cells, or FeatureTransform."},
    {"gl_cloud_too_large",
     "A cloud of {points} points is too large for this OpenGL: at most {most}. Try: "
     "fewer points, or the cpu backend."},
    {"gl_image_too_large",
     "An image of {width} x {height} pixels is too large for this OpenGL: at most "
     "{most} per side. Try: a smaller image, or the cpu backend."},
    {"gl_out_of_memory", "OpenGL is out of memory. Try: {less}, or {instead}."},
    {"gl_failed",
     "OpenGL failed with error {error}. Try: another driver, or {instead}."},
    {"gl_layer_left_open",
     "OpenGL left parts of a layer empty. Try: another driver, or FeatureTransform."},
    {"conic_sections_without_context",
     "Conic sections require an OpenGL context. Try: createHeadlessContext()."},
    {"bad_first_ring_radius",
     "The first ring of a conic section has a radius of {radius} cells: it must be 1 "
     "to {most}."},
    {"bad_first_ring_triangles",
     "The first ring of a conic section has {triangles} triangles: it must have 3 to "
     "{most}."},
    {"gl_library_not_loaded", "The library {library} cannot be loaded. Try: {advice}."},
    {"gl_library_without_function",
     "The library {library} has no function {function}. Try: install a complete "
     "library, or use the cpu backend."},
    {"gl_no_current_context",
     "No EGL, OSMesa or GLX context is current for drawing on \"{context}\". Try: make "
     "it current, or use the cpu backend."},
    {"gl_context_silent",
     "The context \"{context}\" does not respond. Try: make it current, or use the cpu "
     "backend."},
    {"gl_context_too_old",
     "The context \"{context}\" has OpenGL {version}, but 3.3 is required. Try: a "
     "newer driver, or the cpu backend."},
    {"gl_context_without_function",
     "The context \"{context}\" (OpenGL {version}) has no function {function}. Try: "
     "another driver, or the cpu backend."},
    {"gl_card_without_egl",
     "A graphics card can only be chosen for \"egl\", not for \"{context}\"."},
    {"unknown_gl_context",
     "There is no context \"{context}\". Try: \"osmesa\" or \"egl\"."},
    {"egl_without_context",
     "EGL has no OpenGL 3.3 core context {has_card|of graphics card {card} "
     "(zero-based)|{is_hardware|of a graphics card|here}}. Try: {advice}."},
    {"osmesa_without_context",
     "OSMesa has no OpenGL 3.3 core context. Try: install libosmesa6 of Mesa 20 or "
     "newer, or use the cpu backend."},
    {"osmesa_context_refused",
     "OSMesa cannot make its context current. Try: the egl or the cpu backend."},

    // distributed
    {"no_samples_of_ranks", "No process has a sample with a position and a value."},
    {"piece_too_large",
     "A piece of {samples} samples is too large: at most {most} are allowed."},
    {"piece_too_large_with_ghosts",
     "A piece of {samples} samples is too large together with its ghost samples."},
    {"sample_not_in_piece", "Sample {sample} is not in the piece."},
    {"memory_for_pieces",
     "{samples} samples in pieces require at least {least} of memory, but only "
     "{allowed} are allowed."},
    {"memory_for_piece",
     "{samples} adjacent samples, many of them at one position, do not fit into "
     "{allowed} of memory."},
    {"memory_for_block",
     "{samples} samples around one position do not fit into {allowed} of memory."},
    {"memory_for_result",
     "The result does not fit into {allowed} of memory: it requires more than "
     "{needed}. "
     "Try: a larger {-max-memory}."},
    {"scratch_folder_refused",
     "The scratch folder {folder} is not writable: {reason}."},
    {"scratch_folder_full",
     "The scratch folder {folder} is full after {size} of a file: {reason}."},
    {"scratch_file_lost",
     "A file in the scratch folder {folder} cannot be read back: {reason}."},
    {"bad_levels_of_pieces",
     "The number of levels is {levels}: it must be 0 to {most}."},
    {"more_pieces_than_samples",
     "{samples} samples cannot be divided into {pieces} pieces."},
    {"more_levels_than_samples",
     "{samples} samples cannot be divided into 2^{levels} pieces."},
    {"piece_of_other_samples",
     "A piece of {samples} samples cannot be divided by processes that have {held} "
     "samples."},
    {"point_of_no_rank", "No process has the point {point}."},
    {"bad_groups_of_ranks",
     "The number of groups is {groups}: it must be a power of two, at most the number "
     "of processes and of pieces."},

    // mpi
    {"mpi_exchange_failed", "MPI could not exchange messages between the processes."},
    {"mpi_group_failed", "MPI could not form a group of processes."},
    {"other_rank_failed", "Process {rank} failed."},

    // generation
    {"mesh_without_area",
     "The mesh has no area, so points cannot be distributed on it."},
    {"unknown_analytic_field",
     "There is no analytic field '{field}'; the fields are {fields}."},

    // python
    {"bad_triangle_array", "Triangles must be rows of three indices."},
    {"bad_lattice_type", "Lattice files must contain float32, float64 or uint8."},
    {"unknown_numpy_type", "Fields cannot have the type {type}."},
    {"field_type_not_in_numpy",
     "NumPy has no type for the datatype {datatype} of a field."},
    {"memory_for_picture",
     "There is not enough memory for an image of {width} x {height} pixels."},
    {"picture_without_splats", "No splat is usable."},
    {"bad_picture_color", "A colour must be red, green and blue, each 0 to 1."},
    {"bad_picture_range",
     "The colour range must be two numbers, the lower number first."},
    {"bad_logarithmic_range",
     "The range of logarithmic colours must be two positive numbers."},
    {"logarithms_of_categories",
     "Logarithmic colours cannot be combined with the categorical colour map {map}. "
     "Try: a continuous map."},
    {"picture_unit_alone", "A unit requires {-ticks} or {-scale-bar}."},
    {"picture_views_and_eye",
     "{-views} cannot be combined with {-eye}: both define the camera."},
    {"scale_bar_of_several_scales",
     "{-scale-bar} cannot be combined with {-exaggerate}, which has several scales. "
     "Try: {-ticks}."},
    {"picture_too_small_for_views",
     "The image is too small for views and title. Try: a larger size."},
    {"bad_picture_size",
     "The image size {width} x {height} is not allowed: it must be 1 x 1 to {most} x "
     "{most} pixels before averaging."},
    {"picture_at_without_eye", "{-at} requires {-eye}, the position of the camera."},
    {"picture_without_frames", "A full turn requires at least one frame."},
    {"bad_exaggerate", "{-exaggerate} must be three positive factors."},
};

} // namespace

MessageTexts
listErrors()
{
  return {std::begin(error_rows), std::end(error_rows)};
}

} // namespace pcl_uvol::detail
