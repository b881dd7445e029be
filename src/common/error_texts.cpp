// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"

#include <iterator>

namespace pcl_uvol::detail {

namespace {

const MessageText error_rows[] = {
    // common
    {"unknown_message", "There is no message of the code '{code}'."},
    {"field_of_names",
     "The field '{field}' holds names, and a field of numbers is needed: {-where} "
     "chooses among names."},
    {"message_without_value", "The message '{message}' has no value '{value}'."},
    {"cloud_without_xyz",
     "The cloud needs a number each of x, y and z; it has {fields}."},
    {"cloud_beyond_numbers",
     "{points} points are more than PCL can number: take them in pieces."},
    {"cloud_big_endian", "The cloud is big endian: swap its bytes first."},
    {"cloud_too_short",
     "The cloud holds {bytes} bytes, fewer than its {points} points need."},
    {"cloud_incomplete", "The cloud holds fewer bytes than its {points} points need."},
    {"cloud_without_float_xyz",
     "The cloud needs float32 fields x, y, z; it has {fields}."},
    {"field_beyond_point",
     "The field {field} ends beyond the {bytes} bytes of a point of the cloud."},
    {"field_behind_point", "The field '{field}' ends behind its point."},
    {"records_beyond_numbers",
     "{points} points of {bytes} bytes are more than PCL can number."},
    {"stage_without_cloud", "{stage} has no input cloud: call setInputCloud."},
    {"empty_cloud", "{stage} was given an empty cloud."},
    {"no_indices", "{stage} was given no indices of points."},
    {"index_beyond_cloud",
     "{stage} was given the index {index}, but the cloud has {points} points."},
    {"coordinates_beyond_float",
     "The coordinates are larger than float can hold (3.4e38): scale the coordinates "
     "down."},
    {"coordinates_not_in_threes",
     "There are {coordinates} coordinates, which are not three for each point."},
    {"coordinates_of_other_points",
     "There are coordinates of {given} points for a cloud of {points}."},
    {"field_of_wrong_length",
     "The field '{field}' has {values} values for {points} points."},
    {"field_is_coordinate", "The field '{field}' is a coordinate."},
    {"unknown_datatype", "A field has the unknown type {type}."},
    {"unknown_field",
     "There is no field '{field}'; the fields are {fields}.{has_coordinates_only| Data "
     "of cells, in files of VTK, are read by the option cells.|}"},
    {"no_coordinate_field",
     "There is no scalar field {axis}; the fields are {fields}."},
    {"no_scalar_field", "There is no scalar field; the fields are {fields}."},
    {"several_scalar_fields", "Name the scalar field to use, one of {fields}."},
    {"field_of_components",
     "The field '{field}' has {components} components: write {field}[0] to "
     "{field}[{last}] for one of them or |{field}| for their length."},
    {"component_not_number",
     "The component in '{field}' is not a number from 0, as in vel[1]."},
    {"component_too_large",
     "The component in '{field}' is too large: it may be 0 to {last}."},
    {"strike_not_finite",
     "The strike of the axes is {strike} degrees: it must be finite."},
    {"dip_out_of_range", "The dip of the axes is {dip} degrees: it must be 0 to 90."},
    {"plunge_too_steep",
     "The plunge of the axes is {plunge} degrees: it must be no steeper than the dip "
     "of the plane, {dip}."},
    {"scale_map_not_finite", "The nine numbers of the scale must be finite."},
    {"scale_map_flat",
     "The nine numbers of the scale leave a direction without length: their rows must "
     "not lie in one plane."},
    {"parameters_not_json", "The parameters are not JSON."},
    {"wrong_parameter", "The parameter {name} is {value}: it must be {expected}."},
    {"unknown_parameter",
     "There is no parameter {name}{has_similar| (did you mean '{similar}'?)|}: there "
     "are {names}."},
    {"unknown_simd_level",
     "The environment variable PCL_UVOL_SIMD is '{level}': it can be baseline, avx2 or "
     "avx512."},
    {"not_enough_memory",
     "{what} needs {needed} of memory, and only {available} are available."},

    // neighbors
    {"too_many_candidates",
     "The samples crowd in few cells of the Voronoi grid: it gives {candidates} "
     "candidates for neighbours, {per_sample} per sample, of which at most {most} are "
     "allowed. A grid of more cells gives fewer; the kd-tree needs none."},
    {"grid_box_not_ordered",
     "The box of a grid has finite corners, the lower one first."},
    {"grid_cells_out_of_range",
     "A grid has 1 to {most} cells along an axis, not {cells}."},
    {"grid_beyond_numbers", "{grid} has more than the 4 billion that can be numbered."},
    {"voronoi_cells_out_of_range",
     "A Voronoi grid has 1 to {most} cells along each axis."},
    {"voronoi_grid_not_allowed",
     "A grid has 1 to {most} cells along every axis, of finite sides above 0."},
    {"voronoi_grid_without_point",
     "A discrete Voronoi diagram needs a point with finite coordinates."},
    {"margin_of_oblong_cells",
     "A margin is for cubic cells: give one number of cells."},
    {"input_without_point", "The input has no point with finite coordinates."},
    {"scale_beyond_float",
     "The scale {x}, {y}, {z} takes coordinates out of the range of float: choose "
     "factors that are nearer to each other, or scale the coordinates."},
    {"no_finite_value", "No sample has a finite value of {field}."},
    {"no_usable_sample",
     "The cloud has no usable sample: all {samples} given have a non-finite "
     "coordinate."},
    {"no_sample_for_scale", "No sample has finite coordinates to find a scale from."},
    {"exact_neighbors_in_pieces",
     "Exact natural neighbours need all samples in one piece."},
    {"periodic_side_not_allowed",
     "A box that repeats needs sides from 0, where 0 stands for an axis along which it "
     "does not, and {side} is none."},
    {"no_nearest_neighbors",
     "The number of nearest neighbours is 0: it must be at least 1."},
    {"neighbors_not_finite",
     "Sample {sample} has only {found} of {needed} neighbours at a finite distance: "
     "scale the coordinates."},
    {"neighbor_search_null", "The search method for nearest neighbours is null."},

    // interpolation
    {"single_point_box",
     "The box of the grid is a single point: give it another one, by {-box}, say."},
    {"no_finite_sample", "No sample has a finite position."},
    {"too_many_blocks",
     "There are more than 16,777,216 blocks in the box of the samples: larger blocks "
     "are needed."},
    {"block_sides_not_positive", "The sides of blocks must be finite and positive."},
    {"no_block_estimated",
     "No block can be estimated better than by the mean of all samples: all are "
     "outside of the data, or values are not alike at the distances between samples."},
    {"folds_not_allowed",
     "The number of folds is {folds}: it must be 2 to {most}, the number of {things}."},
    {"single_fold", "All samples are in one fold: divide them otherwise."},
    {"values_of_other_points",
     "There are {values} interpolated values for {points} points: ask for the values "
     "at these points."},
    {"interpolation_number", "The {number} is {value}: it must be {allowed}."},
    {"no_model_has_values",
     "No model gives values at the samples that are left out: name the model to use."},
    {"no_field_for_value_outside",
     "A value outside needs a field of single numbers, and '{field}' is none; the "
     "fields are {fields}."},
    {"value_outside_not_held",
     "The field '{field}' cannot hold the value {value:17} outside."},
    {"few_samples_for_value_outside",
     "A value outside needs more than {samples} distinct samples."},
    {"unordered_box",
     "The box of a grid has to be finite, and its second corner above the first."},
    {"plane_misses_data",
     "The plane misses the box of the data, from ({low_x}, {low_y}, {low_z}) to "
     "({high_x}, {high_y}, {high_z})."},
    {"no_finite_point", "There is no point with finite x, y, z."},
    {"line_without_ends", "A line has two different ends, and at least 2 points."},
    {"few_points_of_grid", "A grid has at least 2 points along its longest side."},
    {"no_points_along_axis", "A grid has at least one point along each axis."},
    {"flat_box",
     "The box of the grid has no extent along an axis of which {points} points are "
     "asked for: one fits."},
    {"plane_without_normal", "The normal of a plane has to be finite and not zero."},
    {"few_points_of_slice", "A slice has at least 2 points along each side."},
    {"plane_touches_data", "The plane touches the data in one point only."},
    {"few_samples_for_derivatives",
     "Derivatives need at least four samples with values, and there are {samples}."},
    {"few_places_for_derivatives",
     "Derivatives need samples at four places or more, and there are {places}."},

    // expressions
    {"derivatives_of_blocks",
     "The derivatives in '{field}' are not to be had from points that are read "
     "block by block: leave out {-max-memory}."},
    {"no_derivatives", "The derivatives in '{field}' are not to be had {reason}."},
    {"derivatives_without_coordinates",
     "The derivatives in '{field}' need coordinates, and the points have none."},
    {"no_comparison",
     "'{where}' is no comparison: write one of =, !=, <, <=, >, >= between two fields "
     "or numbers, as in T>=4."},
    {"unknown_lone_field",
     "There is no field '{field}'{has_similar| (did you mean '{similar}'?)|}; the "
     "fields are {fields}.{has_cell_fields| The option cells reads data of cells "
     "instead: {cell_fields}.|}"},
    {"unknown_operand",
     "There is no field '{field}'{has_similar| (did you mean '{similar}'?)|}; the "
     "fields are {fields}.{has_cell_fields| The option cells reads data of cells "
     "instead: {cell_fields}.|}\n{marked_lines}"},
    {"unknown_function",
     "There is no function '{function}'; {has_similar|did you mean {similar}?|there "
     "are {functions}.}\n{marked_lines}"},
    {"unknown_name",
     "The field '{field}' has no name '{name}'{has_similar|; did you mean "
     "'{similar}'?|.}\n{marked_lines}"},
    {"names_not_compared",
     "'{field}' holds names, which = and != compare, as in "
     "{operand}=\"{name}\".\n{marked_lines}"},
    {"several_components",
     "'{name}' has {components} components: write |{operand}| for their length, or "
     "{operand}[0] to {operand}[{last}] for one of them.\n{marked_lines}"},
    {"expression_too_long",
     "The expression has {characters} characters: at most {most} are "
     "computed.\n{marked_lines}"},
    {"expression_without_field", "The expression names no field.\n{marked_lines}"},
    {"expression_too_deep",
     "More than {most} functions and lengths stand in one another.\n{marked_lines}"},
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
    {"single_ampersand", "Conditions are joined by &&.\n{marked_lines}"},
    {"chained_comparisons",
     "Comparisons are joined by &&, as in 1<T && T<2; there are two at "
     "once.\n{marked_lines}"},
    {"no_field_derived", "No field is derived.\n{marked_lines}"},
    {"argument_not_one_number",
     "{function} takes one number per point, as in {function}(rho).\n{marked_lines}"},
    {"argument_not_vector",
     "{function} takes a field of three components or three fields, as in "
     "{function}(vel) or {function}(vx,vy,vz).\n{marked_lines}"},
    {"component_not_in_brackets",
     "A component is a number from 0 between brackets, as in vel[1].\n{marked_lines}"},
    {"operand_component_too_large",
     "The component is too large: it may be 0 to {last}.\n{marked_lines}"},
    {"misplaced_comma",
     "A comma stands where no function has arguments.\n{marked_lines}"},
    {"too_many_arguments", "A function has too many arguments.\n{marked_lines}"},
    {"too_few_arguments", "A function has too few arguments.\n{marked_lines}"},
    {"misplaced_condition", "? and : do not belong together.\n{marked_lines}"},
    {"program_too_long", "It is too long.\n{marked_lines}"},
    {"not_computable", "It cannot be computed.\n{marked_lines}"},

    // isosurface
    {"map_window_negative", "A window in time is a duration from 0."},
    {"map_without_room", "A map of samples needs room for at least one."},
    {"map_cube_not_allowed", "The side of cubes is a length from 0."},
    {"stamp_not_finite", "Samples need a finite stamp."},
    {"extraction_without_isovalue",
     "IsosurfaceExtraction has no isovalue: call setIsoValue or setIsoValues."},
    {"isovalue_not_finite", "The isovalue {isovalue} is not a finite number."},
    {"repeated_isovalue", "The isovalue {isovalue} is given more than once."},
    {"scale_not_positive",
     "The scale {scale} is not allowed: it must be finite and positive."},
    {"edge_ends_beyond_numbers",
     "The isopoints lie between {points} points, more than one process can number."},
    {"isopoints_of_other_edges", "{isopoints} isopoints cannot have {edges} edges."},
    {"edges_of_other_isopoints",
     "interpolateFields needs one edge per isopoint: got {edges} edges."},
    {"edge_outside_samples",
     "An edge points outside the samples: was interpolateFields given the cloud that "
     "the isopoints were extracted from?"},

    // mesh
    {"edge_length_not_allowed",
     "The edge length {length} is not allowed: it must be a length from 0."},
    {"mesh_of_linear_interpolation",
     "A mesh needs interpolation by fits: between samples alone its topology would not "
     "be that of the field."},
    {"mesh_of_voronoi_neighbors",
     "A mesh is made from the cells of the kd-tree: neighbours from Voronoi diagrams "
     "are of no use to it."},
    {"contrary_triangles",
     "At {edges} edges triangles of the surface disagree about which side is outside: "
     "it has no volume as it is, repair the mesh."},
    {"triangle_beyond_vertices",
     "A triangle names vertex {vertex}, but there are {vertices}."},
    {"vertex_not_finite", "Vertex {vertex} of the surface is not finite."},
    {"surface_points_without_normal",
     "No point of the surface has a normal: normals tell where the surface goes, and "
     "which side is outside."},
    {"surface_without_normals",
     "The surface has neither triangles nor normals: uvol_normals estimates normals."},
    {"surface_points_too_few",
     "The points of the surface are too few, or too far from one another, to tell its "
     "area."},
    {"surface_without_points", "A surface without points is no distance away."},
    {"too_many_intersections",
     "More than {most} pairs of triangles of the surface intersect: many lie on one "
     "another, repair the mesh."},
    {"measures_without_surface",
     "SurfaceMeasures has no surface: call setInputSurface."},
    {"inside_without_triangles",
     "Samples inside are found by triangles, and the surface has none."},

    // levelset
    {"initial_sphere_not_allowed",
     "The sphere that the level set starts from needs a finite centre and a radius "
     "above 0."},
    {"initial_box_not_allowed",
     "The box that the level set starts from needs finite corners, the first below the "
     "second along every axis."},
    {"initial_box_turned",
     "A level set that starts from a box goes without a rotation: its sides lie along "
     "x, y and z."},
    {"initial_plane_not_allowed",
     "The plane that the level set starts from needs a finite point and a normal that "
     "is not 0."},
    {"initial_field_not_finite",
     "The field {field} that the level set starts from is not finite everywhere."},
    {"phi_of_other_points",
     "{values} values of phi are not one for each of {points} points."},
    {"isovalue_beyond_values",
     "The isovalue {isovalue} does not part the values of {field}, which are in "
     "[{low}, {high}]: there is no surface to evolve."},
    {"level_set_without_isovalue",
     "LevelSetEvolution has no finite isovalue: call setIsoValue."},
    {"mu_out_of_range", "The weight mu is {mu}: it must be in [0, 1]."},
    {"level_set_scale_not_positive",
     "The scale is {scale}: it must be finite and positive."},
    {"no_level_set_steps", "The number of steps is 0: it must be at least 1."},
    {"level_set_tolerance_not_positive",
     "The tolerance is {tolerance}: it must be above 0."},
    {"narrow_band",
     "The width of the band is {width}: it must be at least 3 spacings, or 0 for "
     "none."},
    {"few_samples_for_stencil",
     "There are {samples} distinct samples: a stencil of {neighbors} neighbours needs "
     "at least one more than that."},
    {"only_outliers_beyond_isovalue",
     "Only outliers lie beyond the isovalue {isovalue}, samples unlike all their "
     "neighbours: there is no surface to evolve. Extract it without smoothing."},
    {"surface_samples_without_extent", "The samples at the surface have no extent."},
    {"start_without_zero_level",
     "The function that the level set starts from has no zero level among the "
     "samples."},
    {"no_slope_at_isovalue",
     "The values beside the isovalue {isovalue} do not change from sample to sample: a "
     "level set goes by their slope. Extract the isosurface without smoothing."},
    {"level_set_diverged", "The level set diverged in step {step}: {advice}."},

    // surface
    {"cloud_without_finite_point", "The cloud has no point with finite coordinates."},
    {"cloud_without_normal",
     "No point of the cloud has a normal, and none can be estimated."},
    {"splat_delta_not_positive",
     "The error bound delta of splats is a number above 0, not {delta}."},
    {"splat_lambda_out_of_range",
     "The coverage factor lambda of splats lies in [0, 1], and is not {lambda}."},
    {"splats_without_extent",
     "All points of the cloud lie at one place: their extent gives no error bound, "
     "which must be given as a length."},
    {"splat_delta_beside_coordinates",
     "The error bound delta of splats is no length beside coordinates as large as "
     "these: it, or the extent of the cloud, must be 1e-12 to 1e15 times as large."},
    {"few_neighbors_for_normals",
     "Normals from {neighbors} neighbours are not possible: k must be at least 2."},
    {"normals_scale_not_positive",
     "The scale of a normal estimation must be finite and positive along every axis."},

    // multivariate
    {"no_attributes",
     "No attributes were named: name one or more of the fields {fields}."},
    {"same_attributes",
     "The attributes '{attribute}' and '{other}' are the same: each counts once."},
    {"no_complete_point",
     "None of the {points} points has a finite value of every attribute."},
    {"only_constant_attributes",
     "All attributes are the same at all points: nothing can be told apart by them."},
    {"attributes_of_empty_cloud", "Attributes were asked for of an empty cloud."},
    {"vertex_without_region",
     "A triangle of the surface names vertex {vertex}, and there are {regions} "
     "regions."},
    {"no_probabilities",
     "The field {field} has values outside [0, 1]: it holds no probabilities."},
    {"labels_of_other_points", "There are {labels} labels for {points} points."},
    {"empty_attribute_table",
     "A projection was asked for of a table with {rows} rows and {attributes} "
     "attributes, and needs one of each at least."},
    {"unfitting_attribute_table",
     "An attribute table of {rows} rows and {attributes} attributes holds {values} "
     "values, and must hold one of each attribute per row."},
    {"unfitting_cluster_labels",
     "There are {labels} cluster labels for {rows} rows of attributes, and must be "
     "as many."},
    {"too_many_core_neighbors",
     "Core distances reach to 0 to 1000 neighbours, not to {neighbors}."},
    {"cluster_of_one_point",
     "The smallest cluster has 2 points or more, not 1; 0 stands for the default."},
    {"cut_distance_not_allowed",
     "The distance at which clusters are cut is a number above 0, or 0 for none, not "
     "{distance}."},
    {"no_points_to_cluster", "The clustering was given no points."},
    {"unfitting_membership",
     "There are {values} membership values and {lengths} smoothing lengths for "
     "{particles} particles, and must be one of each per particle."},
    {"membership_out_of_range",
     "Membership lies in [0, 1], and is not {value} as that of particle {particle}."},
    {"no_such_cluster", "No point is in cluster {cluster}; the labels are: {labels}."},
    {"distance_to_empty_mesh", "A mesh without vertices has no distance field."},
    {"spanning_tree_without_rows",
     "A spanning tree needs rows of one number or more: {values} values are no rows "
     "of {columns}."},
    {"spanning_tree_too_large",
     "A spanning tree of {points} points is too large: 2^31 - 1 are allowed."},
    {"spanning_tree_not_finite",
     "A spanning tree needs finite values: leave out the points that have others."},
    {"regularization_not_allowed",
     "The regularization of Fisher ratios lies in (0, 1], and is not "
     "{regularization}."},
    {"projection_of_other_attributes",
     "The projection was made for other attributes than those of the table."},

    // pipeline
    {"no_sample_with_value", "No sample has a position and a finite value of {field}."},
    {"not_out_of_core",
     "Level sets, an automatic or rotated scale, hold-out tests, meshes, filled "
     "gaps, boxes that repeat and neighbours from Voronoi diagrams need all samples "
     "in memory."},
    {"no_field_for_gaps",
     "Gaps are filled in fields of single numbers, and '{field}' is none; the fields "
     "are {fields}."},
    {"pipeline_without_input", "IsosurfacePipeline has no input: call setInput."},
    {"linear_with_fitted_normals",
     "Normals by fits need interpolation by fits: linear interpolation makes none."},
    {"hold_out_of_one_fold",
     "A hold-out test with 1 fold leaves no samples: give at least 2."},
    {"few_normal_neighbors",
     "Normals from {neighbors} neighbours are not possible: there must be at least 2."},
    {"largest_error_not_allowed",
     "The largest error is {error}: it must be a length from 0."},
    {"two_largest_errors", "The largest error is a length or automatic, not both."},
    {"turned_periodic_box",
     "A box that repeats goes without a rotation: its sides lie along x, y and z."},
    {"hold_out_in_periodic_box",
     "A hold-out test goes without a box that repeats: images of samples that are "
     "left out would tell what they are."},
    {"gaps_in_periodic_box",
     "Gaps are not filled in a box that repeats: samples that kriging adds would "
     "have no images."},
    {"nothing_to_weld",
     "Only a mesh in a box that repeats can be welded across its faces."},
    {"mesh_without_points",
     "A mesh keeps all of its vertices: leave out the bound of the error and bridged "
     "points, or the mesh."},
    {"mesh_with_pca_normals",
     "The vertices of a mesh have the normals of their fits: those by principal "
     "components are for isopoints."},
    {"distributed_scale",
     "An automatic scale is not offered for samples of several processes, as none "
     "sees them all: give three factors."},
    {"distributed_rotation",
     "A rotated scale is not offered for samples of several processes."},
    {"distributed_mesh",
     "A mesh is not offered for samples of several processes: its cells would have "
     "to be joined across their borders."},
    {"distributed_level_set",
     "A level set is not offered for samples of several processes."},
    {"distributed_gaps",
     "Gaps are not filled in samples of several processes: no one sees them all."},
    {"distributed_hold_out",
     "A hold-out test is not offered for samples of several processes."},
    {"distributed_normals",
     "Isopoints of several processes have the normals of their fits, else of their "
     "edges; others are not offered."},
    {"distributed_without_input",
     "DistributedIsosurfacePipeline has no input: call setInput."},

    // render
    {"cloud_without_usable_splats", "none of the splats in '{cloud}' is usable"},
    {"cloud_without_extent",
     "all points of '{cloud}' lie at one place, which cannot be fitted to a size"},
    {"splat_beyond_float",
     "a splat of '{cloud}' becomes larger or smaller than float can hold, or goes "
     "beyond 1e18"},
    {"material_beyond_one",
     "Reflectivity and transparency are 0 or more and together at most 1, not "
     "{reflectivity} and {transparency}."},
    {"bad_refractive_index", "A refractive index is above 0, and is not {index}."},
    {"object_without_splats", "An object of splats has none."},
    {"colors_unlike_splats", "An object of {splats} splats has {colors} colours."},
    {"rims_unlike_splats", "An object of {splats} splats has {rims} rims."},
    {"object_with_bad_splat",
     "An object has a splat that is not finite, without normal or radius, or farther "
     "away than 1e18."},
    {"scene_without_objects", "The scene has no objects."},
    {"bad_sphere", "A sphere has a finite centre and a radius above 0."},
    {"bad_plane",
     "A plane has a finite point, a normal that is not zero, and squares of 0 or "
     "more."},
    {"bad_occlusion_distance", "The distance of occlusion is 0 or more."},
    {"ray_tracer_without_scene", "RayTracer has no scene: call setScene."},
    {"stretched_splats",
     "Splats cannot be stretched: draw the points that they were made of."},
    {"camera_up_of_zero", "The upward direction of a camera is 0,0,0, which is none."},
    {"camera_without_sight", "A camera looks from one finite place to another one."},
    {"camera_up_along_sight",
     "The upward direction of a camera is not zero nor along its line of sight."},
    {"bad_field_of_view",
     "A field of view is between 0 and 180 degrees, not {degrees}."},
    {"unknown_view",
     "There is no view '{view}': choose front, back, left, right, top, bottom or iso."},
    {"render_setting_out_of_range",
     "The {name} lies between {low} and {high}, and is not {number}."},
    {"render_setting_not_positive", "The {name} is a number above 0, not {number}."},
    {"bad_render_color",
     "The colour of {name} has finite parts of 0 or more, not {number}."},
    {"bad_material_factor",
     "The factors of a material are finite and 0 or more, not {factor}."},
    {"light_from_nowhere",
     "A light comes from a finite place, or from a direction that is not zero."},
    {"bad_light_radius",
     "The radius of a light is finite and 0 or more, not {radius}."},
    {"bad_ambient_occlusion",
     "The strength of ambient occlusion is a number from 0 to 1, not {strength}."},
    {"surface_prepared_of_others",
     "The surface was prepared of {prepared} points, and {drawn} are to be drawn."},
    {"colors_unlike_points", "There are {colors} colours for {points} points."},
    {"bad_opacity", "Opacities are numbers from 0 to 1, not {opacity}."},
    {"opacities_unlike_isovalues",
     "Opacities are one for all isovalues, or one for each, the lowest isovalue first: "
     "there are {isovalues} isovalues, and {opacities} opacities."},
    {"planes_with_supersampling",
     "Planes of an image cannot be averaged: render depth, normal or id without "
     "supersampling."},
    {"planes_with_opacities",
     "Transparent surfaces have no planes: render depth, normal or id without "
     "opacities."},
    {"bad_image_size",
     "An image of {width} x {height} pixels cannot be drawn: both numbers lie between "
     "1 and {most}."},
    {"unknown_color_map",
     "There is no colour map '{map}': choose one of {maps}, or one of them with _r "
     "behind it to run backwards."},
    {"bad_color_range", "A colour range is two finite numbers, the lower one first."},
    {"bad_mapped_color_range",
     "A colour range is two finite numbers, the lower one first, and both above 0 on a "
     "logarithmic scale."},
    {"cloud_without_colors",
     "The cloud has no colours (rgb, rgba, or red, green and blue of a byte each); its "
     "fields are {fields}."},
    {"color_field_without_numbers", "All values of {field} are without a number."},
    {"color_field_without_logarithms",
     "No value of {field} is above 0, which its logarithm needs."},

    // vtk
    {"unfitting_grid_values",
     "A grid of {cells} cells has a value for each of them, not {values} values."},
    {"no_opengl_window", "Image-space rendering needs an OpenGL window of VTK."},
    {"uneven_camera",
     "Image-space rendering takes a camera and a cloud that are turned, moved and "
     "scaled by the same factor along all axes only: remove other scales, shears and "
     "mirrors."},
    {"unknown_projection",
     "Image-space rendering takes perspective and parallel projections only."},
    {"no_opengl_camera", "Image-space rendering needs VTK's OpenGL camera."},
    {"stretched_pixels",
     "Image-space rendering needs square pixels: remove the renderer's pixel aspect."},
    {"cluster_distance_not_allowed",
     "The distance of a surface from a cluster is a number above 0, or 0 for that of "
     "the spanning tree."},
    {"cluster_at_one_place",
     "All points of the cluster lie at one place, which gives no distance: it must "
     "be given."},
    {"no_hull",
     "The cluster has no hull: fewer than three of its points meet on a surface "
     "around them{has_outlier|, as the point of index {point} lies {ratio} times as "
     "far from the middle as half of them do: leave it out|}."},
    {"cluster_too_large",
     "The surface around the cluster would be larger than float can hold (3.4e38): "
     "scale the coordinates down."},
    {"cluster_without_positions", "The cluster has no point with finite coordinates."},
    {"few_points_for_hull",
     "A hull needs three points or more, and the cluster has {points}."},
    {"small_cluster_distance",
     "The distance {distance} is too small for cells of {cell}: choose a finer grid "
     "or a larger distance."},

    // filters
    {"no_vtk_data", "There are no VTK data to make a cloud of."},
    {"array_not_of_points",
     "The {array} was not chosen among those of points, which it has to be: "
     "vtkCellDataToPointData makes such of those of cells."},
    {"no_such_array",
     "There is no {array} of points: choose one by SetInputArrayToProcess; those of "
     "numbers are {arrays}."},
    {"array_of_other_points",
     "The {array} is a {type} of {tuples} tuples for {points} points, not one of "
     "numbers for each; those are {arrays}."},
    {"no_such_component",
     "The {array} has {components} components: there is no component {component} "
     "(from 0)."},
    {"empty_source", "The source has no points to interpolate between."},

    // io
    {"some_coordinates_named",
     "Cannot read '{path}': its header names only some of x, y and z, as by "
     "'{column}': choose the columns of the coordinates by their names or numbers "
     "({-xyz})."},
    {"only_times_named",
     "Cannot read '{path}': its header names no coordinates but times: choose the "
     "columns of the coordinates by their names or numbers ({-xyz})."},
    {"z_is_missing",
     "Cannot read '{path}': it has x and y, and z is missing. Samples in a plane need "
     "a z, which can be 0 everywhere."},
    {"filter_not_installed",
     "Cannot read '{path}': the numbers of '{name}' are packed by the filter {filter} "
     "({id}) of HDF5, which is not installed. Try: h5repack -f GZIP=4 packs them in a "
     "way that is read, where the filter is installed."},
    {"swapped_bytes",
     "Cannot read '{path}': the bytes of the numbers of '{name}' are in the order of "
     "this machine, and legacy VTK files are big-endian. Try: a program that writes "
     "them so, or the format .vtu."},
    {"tecplot_blocks",
     "Cannot read '{path}': its zone lists one variable after the other (BLOCK). Try: "
     "write it with DATAPACKING=POINT, which is read."},
    {"coordinate_below_limit",
     "Cannot read '{path}': its coordinate {column} has numbers below a limit, as "
     "<0.25."},
    {"whole_numbers_guessed",
     "Cannot read '{path}': its header names no coordinates, and whole numbers as "
     "in '{column}' may be anything: choose the columns of the coordinates by their "
     "names or numbers ({-xyz})."},
    {"no_coordinate_column",
     "there is no column '{column}' for a coordinate; columns are '{first}' to "
     "'{last}', or 0 to {most}"},
    {"repeated_coordinate_column", "the coordinates need three different columns"},
    {"columns_of_no_text",
     "Columns of coordinates can be chosen in text files only, and '{path}' is none."},
    {"particles_of_no_snapshot",
     "Particles can be chosen in snapshots only, and '{path}' is none."},
    {"cells_of_no_grid",
     "Cells can be chosen in files of VTK but .vtkhdf, Exodus, EnSight and OpenFOAM "
     "only, and '{path}' is none."},
    {"unreadable", "Cannot read '{path}': {reason}."},
    {"unreadable_line", "Cannot read '{path}', line {line}: {reason}."},
    {"unwritable", "Cannot write '{path}': {reason}."},
    {"resolution_not_allowed",
     "A picture has 1 to a million dots per inch, or 0 where it does not say how "
     "many, not {resolution}."},
    {"png_not_encoded", "libpng could not encode a picture: {reason}."},
    {"image_without_pixels", "The image has no pixels."},
    {"empty_scene", "'{path}' draws nothing: it has no cloud, sphere or plane."},
    {"scene_line", "{place}: {reason}."},
    {"vtk_library_not_loaded",
     "The library for VTK, HDF5, NetCDF and text in pictures could not be loaded: it "
     "is not beside libpcl_uvol_io.so, or there is not enough memory."},
    {"no_such_point", "There is no point {point} in a file of {points}."},
    {"unsorted_points", "The points to be read are not in ascending order."},
    {"too_many_points_for_process",
     "A process would have to take {points} points, and can take {most}: use more "
     "processes."},
    {"pieces_of_other_fields",
     "The pieces '{one}' and '{other}' have different fields: where the one has "
     "{fields}, the other has {other_fields}; write all of them with the same arrays."},
    {"names_in_one_piece",
     "The field '{field}' holds names in the piece '{path}' and numbers in "
     "'{other}': join them to one file, where names may be numbers."},
    {"pieces_without_points", "None of the {pieces} pieces has points."},
    {"no_file_to_read", "No file is given to be read."},

    // io_vtk
    {"unknown_snapshot",
     "Cannot read '{path}': {-particles} chooses from snapshots, and this is none "
     "that is known."},

    // tools
    {"no_points", "{path} has no points."},

    // derivatives
    {"few_neighbors_for_scheme",
     "The number of neighbours is {neighbors}: it must be at least {least} with this "
     "scheme."},

    // gl
    {"gl_shader_not_compiled",
     "The driver does not compile a shader, use the cpu backend instead: {log}"},
    {"gl_shader_not_linked",
     "The driver does not link a shader, use the cpu backend instead: {log}"},
    {"gl_buffers_refused",
     "The driver cannot draw into the buffers of this image: use a smaller image, or "
     "the cpu backend."},
    {"gl_backend_without_context",
     "An OpenGL backend needs a context: create one by createHeadlessContext()."},
    {"gl_tiles_too_small", "Tiles of a picture have sides of at least {least} pixels."},
    {"gl_layers_too_large",
     "Layers of {width} x {height} cells are too large for this OpenGL, which draws at "
     "most {most} along a side: use fewer cells, or the FeatureTransform."},
    {"gl_cloud_too_large",
     "A cloud of {points} points is too large for this OpenGL, which draws at most "
     "{most}: use fewer points, or the cpu backend."},
    {"gl_image_too_large",
     "An image of {width} x {height} pixels is too large for this OpenGL, which has at "
     "most {most}: use a smaller one, or the cpu backend."},
    {"gl_out_of_memory", "OpenGL is out of memory: use {less}, or {instead}."},
    {"gl_failed", "OpenGL fails with error {error}: use another driver, or {instead}."},
    {"gl_layer_left_open",
     "OpenGL leaves parts of a layer open: use another driver, or the "
     "FeatureTransform."},
    {"conic_sections_without_context",
     "Conic sections are drawn in an OpenGL context: create one by "
     "createHeadlessContext()."},
    {"bad_first_ring_radius",
     "The first ring of a conic section has a radius of 1 to {most} cells, not "
     "{radius}."},
    {"bad_first_ring_triangles",
     "The first ring of a conic section has 3 to {most} triangles, not {triangles}."},
    {"gl_library_not_loaded", "The library {library} cannot be loaded: {advice}."},
    {"gl_library_without_function",
     "The library {library} has no function {function}: install a complete one, or use "
     "the cpu backend."},
    {"gl_no_current_context",
     "No context of EGL, OSMesa or GLX is current where \"{context}\" is drawn: make "
     "it current, or use the cpu backend."},
    {"gl_context_silent",
     "The context \"{context}\" does not answer: make it current, or use the cpu "
     "backend."},
    {"gl_context_too_old",
     "The context \"{context}\" has OpenGL {version}, but 3.3 is needed: use a newer "
     "driver, or the cpu backend."},
    {"gl_context_without_function",
     "The context \"{context}\" (OpenGL {version}) has no function {function}: use "
     "another driver, or the cpu backend."},
    {"gl_card_without_egl",
     "A graphics card is chosen for \"egl\" only, not for \"{context}\"."},
    {"unknown_gl_context",
     "There is no context \"{context}\": use \"osmesa\" or \"egl\"."},
    {"egl_without_context",
     "EGL has no OpenGL 3.3 core context {has_card|of graphics card {card}, counted "
     "from 0|{is_hardware|of a graphics card|here}}: {advice}."},
    {"osmesa_without_context",
     "OSMesa has no OpenGL 3.3 core context: install libosmesa6 of Mesa 20 or newer, "
     "or use the cpu backend."},
    {"osmesa_context_refused",
     "OSMesa refuses to make its context current: use the egl or the cpu backend "
     "instead."},

    // distributed
    {"no_samples_of_ranks", "No process has a sample with a position and a value."},
    {"piece_too_large",
     "A piece of {samples} samples is too large: {most} are allowed."},
    {"piece_too_large_with_ghosts",
     "A piece cannot hold {samples} samples with those around it."},
    {"sample_not_in_piece", "The piece does not hold sample {sample}."},
    {"memory_for_pieces",
     "To take {samples} samples through memory in pieces takes at least {least} of it, "
     "and {allowed} were allowed."},
    {"memory_for_piece",
     "{samples} samples lie together, many of them at one place: they do not fit into "
     "{allowed} of memory."},
    {"memory_for_block",
     "{samples} samples around one place do not fit into {allowed} of memory."},
    {"memory_for_result",
     "The result alone takes more than {needed} of memory, and {allowed} were "
     "allowed."},
    {"scratch_folder_refused", "The scratch folder {folder} takes no files: {reason}."},
    {"scratch_folder_full",
     "The scratch folder {folder} took no more than {size} of a file: {reason}."},
    {"scratch_file_lost",
     "A file in the scratch folder {folder} cannot be read back: {reason}."},
    {"bad_levels_of_pieces", "{levels} levels are not allowed: 0 to {most} are."},
    {"more_pieces_than_samples",
     "{samples} samples cannot be parted into {pieces} pieces."},
    {"more_levels_than_samples",
     "{samples} samples cannot be parted into 2^{levels} pieces."},
    {"piece_of_other_samples",
     "A piece of {samples} samples cannot be parted by processes that have {held}."},
    {"point_of_no_rank", "No process has the point {point}."},
    {"bad_groups_of_ranks",
     "{groups} groups are not allowed: a power of two that is no larger than the "
     "number of processes and that of pieces is."},

    // mpi
    {"mpi_exchange_failed", "MPI could not exchange messages between the processes."},
    {"mpi_group_failed", "MPI could not form a group of processes."},
    {"other_rank_failed", "Process {rank} failed."},

    // generation
    {"mesh_without_area", "The mesh has no area to spread points over."},
    {"unknown_analytic_field",
     "There is no analytic field '{field}'; there are {fields}."},

    // python
    {"bad_triangle_array", "Triangles are rows of three indices."},
    {"bad_lattice_type", "Files of lattices hold float32, float64 and uint8."},
    {"unknown_numpy_type", "Fields have no type {type}."},
    {"field_type_not_in_numpy", "Numpy has no type for a field's datatype {datatype}."},
    {"bad_smoothing_length", "A smoothing length is a number from 0."},
    {"memory_for_picture",
     "There is not enough memory for a picture of {width} x {height} pixels."},
    {"picture_without_splats", "None of the splats is usable."},
    {"bad_picture_color", "A colour is red, green and blue, from 0 to 1 each."},
    {"bad_picture_range", "The range of colours is two numbers, the lower one first."},
    {"bad_logarithmic_range",
     "The range of logarithmic colours is two numbers above 0."},
    {"logarithms_of_categories",
     "Logarithmic colours need a map of shades, and {map} is one of categories."},
    {"picture_unit_alone",
     "A unit is that of {-ticks} or of {-scale-bar}: ask for one."},
    {"picture_views_and_eye",
     "{-views} and {-eye} both say where the camera is: give one of them."},
    {"scale_bar_of_several_scales",
     "{-scale-bar} needs one scale for all directions, and {-exaggerate} has several; "
     "{-ticks} show them."},
    {"picture_too_small_for_views",
     "The picture is too small for views and title: a larger size helps."},
    {"bad_picture_size",
     "A picture is from 1 x 1 to {most} x {most} pixels before averaging, not {width} "
     "x {height}."},
    {"picture_at_without_eye",
     "{-at} is where a camera looks that has a place: give {-eye}."},
    {"picture_without_frames", "A full turn has at least one frame."},
    {"bad_exaggerate", "{-exaggerate} is three factors above 0."},
};

} // namespace

MessageTexts
listErrors()
{
  return {std::begin(error_rows), std::end(error_rows)};
}

} // namespace pcl_uvol::detail
