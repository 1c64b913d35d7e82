SWAN   1   Swan standard spectral file, version
$ made up
TIME
 1
LONLAT
 1
 5.0 54.0
AFREQ
 3
 0.08
 0.10
 0.12
NDIR
 8
 0
 45
 90
 135
 180
 225
 270
 315
QUANT
 1
VaDens variance densities
m2/Hz/degr
 -99
20261130.000000
FACTOR
 0.0001
 0 0 100 0 0 0 0 0
 5 5 100 5 5 5 5 5
 10 10 100 10 10 10 10 10
