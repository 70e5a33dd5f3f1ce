#!/bin/sh
# mpirun.sh MPIRUN N PROGRAM...: as many processes as asked for, whoever the user is and however many processors there are.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_btl=${OMPI_MCA_btl-^tcp} # on one machine; without a network it complains
export OMPI_MCA_mpi_yield_when_idle=1 # there may be more processes than processors
mpirun=$1 n=$2
shift 2
exec "$mpirun" --oversubscribe -np "$n" "$@"
