BEGIN { FS = OFS = ","; srand(1) }
function normal() { return sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand()) }
NR == 1 { print "t_s,surge_m,heave_m,pitch_deg,wave_m"; next }
{ print $1, $2 + 0.02 * normal(), $3 + 0.005 * normal(), 57.29578 * $4 + 0.02 * normal(), $5 + 0.01 * normal() }
