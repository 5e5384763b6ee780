/* SPDX-License-Identifier: MIT
 *
 * mpi_bytes.c - linked into a host, it counts the bytes that the host gives to MPI with the tag of the halo's
 * values (that of cloud_exchange), and prints their sum over all ranks at the end.
 */
#include <mpi.h>
#include <stdio.h>

enum { TAG = 1203 };
static long long bytes;
static void count(int number, MPI_Datatype type, int tag)
{
    int size;
    MPI_Type_size(type, &size);
    if (tag == TAG) bytes += (long long)number * size;
}
int MPI_Send(const void *buffer, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
    count(number, type, tag);
    return PMPI_Send(buffer, number, type, to, tag, comm);
}
int MPI_Rsend(const void *buffer, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
    count(number, type, tag);
    return PMPI_Rsend(buffer, number, type, to, tag, comm);
}
int MPI_Isend(const void *buffer, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
    count(number, type, tag);
    return PMPI_Isend(buffer, number, type, to, tag, comm, request);
}
int MPI_Finalize(void)
{
    long long all = 0;
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Reduce(&bytes, &all, 1, MPI_LONG_LONG, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("bytes %lld\n", all);
    return PMPI_Finalize();
}
