# SPDX-License-Identifier: MIT
# Turns programs written for peri 0.1 into such for 0.2 as far as text can: sed -E -i -f migrate.sed *.c
# What is left to do by hand is in docs/migration.md. GNU sed (\b, a newline within the pattern space, /dev/stderr).

# A file is read in whole. One that has names of 0.2 is left alone, because peri_apply_traction, peri_bond_count and the cuts are names of
# both versions, of other meaning: to run this twice changes nothing. What a first run makes of these three is among the names looked for
# (a peri_apply_traction of 0.2 has seven arguments, of 0.1 six).
:slurp
$!{
N
b slurp
}
/\b(peri_(advance|solve|choose|material)_desc|peri_(apply_layer_traction|entry_count|body_clone|get_error|get_field|export_vtu)|PERI_CUT_(INITIAL|NOW|IN_PLACE)|PERI_SPACE_(PLANE_STRESS|PLANE_STRAIN|SOLID)|PERI_(LAW|AXIS)_[A-Z_]+|PERI_FIELD_(DAMAGE|POSITION|DISPLACEMENT|VELOCITY|STRESS|STRAIN))\b|\bperi_apply_traction\((([^(),]|\(([^()]|\([^()]*\))*\))*,){6}([^(),]|\(([^()]|\([^()]*\))*\))*\)/{
h
s//\x01&/
s/.*\x01(\w+).*/migrate.sed: left alone, as it is of 0.2: a file with \1/
w /dev/stderr
g
b
}

# settings of a call are its descriptor
s/\bperi_statics_report\b/peri_solve_report/g
s/\bperi_statics_init\b/peri_solve_desc_init/g
s/\bperi_statics\b/peri_solve_desc/g
s/\bperi_run_init\b/peri_advance_desc_init/g
s/\bperi_run\b/peri_advance_desc/g
s/\bperi_material_init\b/peri_material_desc_init/g
s/\bperi_material\b/peri_material_desc/g
s/\bperi_goal_init\b/peri_choose_desc_init/g
s/\bperi_goal\b/peri_choose_desc/g
s/\bperi_choice\b/peri_choose_report/g
s/\bperi_model\b/peri_law/g

# get and set for what a body knows, export for files, create and clone for objects
s/\bperi_last_error\b/peri_get_error/g
s/\bperi_error_format\b/peri_format_error/g
s/\bperi_read_(bond_constants|critical_energy|families|set|energy|momentum|memory|reaction|obstacle_force|matrix)\b/peri_get_\1/g
s/\bperi_set_size\b/peri_size_of_set/g
s/\bperi_field_size\b/peri_size_of_field/g
s/\bperi_write_(vtu|history|matrix)\b/peri_export_\1_to/g
s/\bperi_save_(vtu|history)\b/peri_export_\1/g
s/\bperi_read\b/peri_get_field/g
s/\bperi_write\b/peri_set_field/g
s/\bperi_bond_count\b/peri_entry_count/g
s/\bperi_clone\b/peri_body_clone/g
s/\bperi_assemble\b/peri_matrix_create/g

# the plain name is the one that is right to first order
s/\bperi_apply_traction\b/peri_apply_layer_traction/g
s/\bperi_apply_surface_traction\b/peri_apply_traction/g
s/\bperi_apply_bond_pressure\b/peri_apply_bond_pressure_for_comparison/g

# a cut says what it is; PERI_CUT_NOW where it is made after the first step
s/\bperi_cut_(segment|polyline|disc|triangle|rectangle|pairs|if)\(([^(),]+), */peri_cut_\1(\2, PERI_CUT_INITIAL, /g

# a material, load or obstacle by its plain number: the id that it has
s/\bperi_(add_(box|ball|shape|perturbed_box)|get_critical_energy)\(([^(),]+), *([0-9]+),/peri_\1(\3, peri_id(\3, PERI_KIND_MATERIAL, \4 + 1),/g
s/\bperi_(set_interface|get_bond_constants)\(([^(),]+), *([0-9]+), *([0-9]+),/peri_\1(\2, peri_id(\2, PERI_KIND_MATERIAL, \3 + 1), peri_id(\2, PERI_KIND_MATERIAL, \4 + 1),/g
s/\bperi_(get_reaction|remove_load)\(([^(),]+), *([0-9]+)([,)])/peri_\1(\2, peri_id(\2, PERI_KIND_LOAD, \3 + 1)\4/g
s/\bperi_get_obstacle_force\((([^()]|\(([^()]|\([^()]*\))*\))*)\)/peri_get_obstacle_force(\1, NULL)/g
s/\bperi_(get_obstacle_force|remove_obstacle)\(([^(),]+), *([0-9]+)([,)])/peri_\1(\2, peri_id(\2, PERI_KIND_OBSTACLE, \3 + 1)\4/g

# enums
s/\bPERI_(PLANE_STRESS|PLANE_STRAIN|SOLID)\b/PERI_SPACE_\1/g
:type
s/(\btype\b[^\n]*\bPERI_)(F64|F32)\b/\1TYPE_\2/
t type
s/\bPERI_(F64|F32)\b([^\n]*\btype\b)/PERI_TYPE_\1\2/
t type
s/\bPERI_F64\b/PERI_PRECISION_DOUBLE/g
s/\bPERI_F32\b/PERI_PRECISION_SINGLE/g
s/\bPERI_MIXED\b/PERI_PRECISION_MIXED/g
s/\bPERI_I32\b/PERI_TYPE_I32/g
s/\bPERI_(NONLINEAR|LINEAR)\b/PERI_GEOMETRY_\1/g
s/\bPERI_FULL_VOLUME\b/PERI_QUADRATURE_FULL/g
s/\bPERI_VOLUME_RAMP\b/PERI_QUADRATURE_RAMP/g
s/\bPERI_PARTIAL_VOLUME\b/PERI_QUADRATURE_PARTIAL/g
s/\bPERI_PARTIAL_(CENTROID|MOMENT)\b/PERI_QUADRATURE_PARTIAL_\1/g
s/\bPERI_NO_CORRECTION\b/PERI_CORRECTION_NONE/g
s/\bPERI_(VOLUME|ENERGY|MOMENT)_CORRECTION\b/PERI_CORRECTION_\1/g
s/\bPERI_(BASELINE|AVX2|AVX512)\b/PERI_INSTRUCTIONS_\1/g
s/\bPERI_(BOND_BASED|LPS|OTERKUS|CORRESPONDENCE)\b/PERI_LAW_\1/g
s/\bPERI_(VELOCITY_VERLET|CENTRAL_DIFFERENCE)\b/PERI_INTEGRATOR_\1/g
s/\bPERI_(NEWTON|BICGSTAB|RELAXATION)\b/PERI_METHOD_\1/g
s/\bPERI_(MULTILEVEL|BLOCK_JACOBI)\b/PERI_PRECONDITIONER_\1/g
s/\bPERI_NO_PRECONDITIONER\b/PERI_PRECONDITIONER_NONE/g
s/\bPERI_FOR_(DEFORMATION|STRESS|WAVES|FRACTURE)\b/PERI_QUANTITY_\1/g
s/\bPERI_CURRENT\b/PERI_FIELD_CURRENT_POSITION/g
s/\bPERI_(POSITION|DISPLACEMENT|VELOCITY|FORCE_DENSITY|VOLUME|MATERIAL|FAMILY_SIZE|DAMAGE|DAMAGE_GROWN|ENERGY_DENSITY|DILATATION|STRAIN|STRESS|FORCE_STRESS|REACTION)\b/PERI_FIELD_\1/g
s/\bPERI_([XYZ])\b/PERI_AXIS_\1/g
s/\bPERI_ERROR_MODEL\b/PERI_ERROR_LAW/g
s/\bPERI_ERROR_NO_POINTS\b/PERI_ERROR_EMPTY/g
s/(\.|->)model\b/\1law/g
