# Invented reports, which the page's tests open in a browser.
add_executable(sample_report app/report/sample_report.cpp app/report/sample_data.cpp
               app/report/sample_pictures.cpp)
target_link_libraries(sample_report PRIVATE pssmlt_app pssmlt_flags)
# In a browser where there is one; else the test is shown as skipped.
add_test(NAME app.ReportPage COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/report/browser/run
         $<TARGET_FILE:sample_report>)
set_tests_properties(app.ReportPage PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
