!> The order in which histories are taken from their queue.
program test_queue
   use checks, only : check, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_motion_queue, only : queue_type
   use dondolo_motion_response, only : response_type
   implicit none

   type(queue_type) :: queue
   type(response_type), allocatable :: taken(:)
   integer :: i

   call suite('order')
   ! Of the records 1 to 4, of which 4 has no history, 2 lasts longest and 3 is the shortest.
   call queue%fill([1, 2, 3, 1, 2, 3, 2], [(real(i, wp), i=1, 7)], [3, 1, 4, 2])
   call check(all([(queue%next(), i=1, 7)] == [7, 5, 2, 4, 1, 6, 3]), 'the longest first, and of a record the last')
   call check(all([(queue%next(), i=1, 3)] == 0), 'none is left')
   call move_alloc(queue%response, taken)
   call queue%fill([2, 1], [1.0_wp, 1.0_wp], [1, 2])
   call check(all([(queue%next(), i=1, 3)] == [1, 2, 0]), 'filled again')
   call queue%fill([integer ::], [real(wp) ::], [1])
   call check(queue%next() == 0, 'empty')
   call finish()

end program test_queue
