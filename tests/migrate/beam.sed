# SPDX-License-Identifier: MIT
# the second solve goes on at the load factor at which the body stands: load_from need not be given
/solve\.load_from = 0\.5;/d
