!> Statistics of the quantities of a study, over its rows
module axijoint_study_statistics
   use axijoint_base_kinds, only : wp
   use axijoint_study_draw, only : generator_type, new_generator, next_uniform
   use axijoint_study_rows, only : row_type
   implicit none
   private
   public :: statistics_type, new_statistics, statistic_names

   !> The statistics: of a sample, the mean with the ends of its interval of 95 % confidence
   character(len=16), parameter :: statistic_names(10) = [character(len=16) :: 'count', 'mean', &
      'deviation', 'least', 'percent 5', 'median', 'percent 95', 'greatest', 'mean from', 'mean to']
   !> Samples with replacement that the interval is found by
   integer, parameter :: n_resamples = 1000

   !> Statistics
   type :: statistics_type
      !> Shape (statistics, quantities)
      real(wp), allocatable :: values(:, :)
   end type statistics_type

contains

   !> Statistics of the quantities at the end of rows that are in equilibrium
   function new_statistics(rows, n_quantities) result(statistics)
      !> The rows
      type(row_type), intent(in) :: rows(:)
      !> Quantities of each
      integer, intent(in) :: n_quantities
      !> The statistics; of no rows zeros
      type(statistics_type) :: statistics

      real(wp), allocatable :: samples(:, :), sample(:)
      integer, allocatable :: good(:)
      integer :: q, k

      allocate (statistics%values(size(statistic_names), n_quantities), source=0.0_wp)
      good = pack([(k, k=1, size(rows))], &
                  [(rows(k)%number > 0 .and. rows(k)%code == 0, k=1, size(rows))])
      if (size(good) == 0) return
      allocate (samples(n_quantities, size(good)))
      do k = 1, size(good)
         associate (values => rows(good(k))%values)
            samples(:, k) = values(:n_quantities, size(values, 2))
         end associate
      end do
      do q = 1, n_quantities
         sample = samples(q, :)
         call sort(sample)
         samples(q, :) = sample
         statistics%values(:8, q) = of_sample(sample)
      end do
      statistics%values(9:, :) = intervals_of_means(samples)
   end function new_statistics

   !> Statistics of a sample, without the interval of its mean
   function of_sample(sample) result(values)
      !> The sample, ascending
      real(wp), intent(in) :: sample(:)
      !> The statistics
      real(wp) :: values(8)

      real(wp) :: mean, deviation

      mean = sum(sample)/size(sample)
      deviation = sqrt(sum((sample - mean)**2)/max(1, size(sample) - 1))
      values = [real(size(sample), wp), mean, deviation, sample(1), at_share(0.05_wp), &
                at_share(0.5_wp), at_share(0.95_wp), sample(size(sample))]

   contains

      !> Value that a share of the sample lies below, between two of them
      pure real(wp) function at_share(share)
         !> The share
         real(wp), intent(in) :: share

         real(wp) :: place
         integer :: k

         place = 1.0_wp + share*(size(sample) - 1)
         k = min(int(place), size(sample) - 1)
         at_share = sample(size(sample))
         if (k > 0) at_share = sample(k) + (place - k)*(sample(k + 1) - sample(k))
      end function at_share

   end function of_sample

   !> Intervals of 95 % confidence of the means, by samples with replacement (Efron, Ann. Statist. 7,
   !> 1979): the same places of all samples
   function intervals_of_means(samples) result(ends)
      !> The samples, each ascending, shape (samples, values)
      real(wp), intent(in) :: samples(:, :)
      !> The ends, shape (2, samples)
      real(wp) :: ends(2, size(samples, 1))

      type(generator_type) :: generator
      real(wp) :: means(size(samples, 1), n_resamples), sorted(n_resamples), share
      integer :: i, k

      if (size(samples, 2) == 1) then
         ends = spread(samples(:, 1), 1, 2)
         return
      end if
      associate (n => size(samples, 2))
         generator = new_generator(1, n)
         means = 0.0_wp
         do k = 1, n_resamples
            do i = 1, n
               call next_uniform(generator, share)
               means(:, k) = means(:, k) + samples(:, min(n, 1 + int(share*n)))
            end do
         end do
         means = means/n
      end associate
      do i = 1, size(means, 1)
         sorted = means(i, :)
         call sort(sorted)
         ends(:, i) = sorted([nint(0.025_wp*n_resamples), nint(0.975_wp*n_resamples)])
      end do
   end function intervals_of_means

   !> Sort ascending
   pure recursive subroutine sort(values)
      !> The values
      real(wp), intent(inout) :: values(:)

      real(wp) :: pivot, kept
      integer :: i, j

      if (size(values) < 2) return
      pivot = values((size(values) + 1)/2)
      i = 1
      j = size(values)
      do
         do while (values(i) < pivot)
            i = i + 1
         end do
         do while (values(j) > pivot)
            j = j - 1
         end do
         if (i <= j) then
            kept = values(i)
            values(i) = values(j)
            values(j) = kept
            i = i + 1
            j = j - 1
         end if
         if (i > j) exit
      end do
      call sort(values(:j))
      call sort(values(i:))
   end subroutine sort

end module axijoint_study_statistics
